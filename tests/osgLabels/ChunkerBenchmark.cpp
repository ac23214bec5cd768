// SPDX-License-Identifier: MIT
// Time and memory of finding a scene's labels, of looking them up and of gathering its Drawables.
#include <osgLabels/Chunker.h>
#include <osgLabels/LabelCollector.h>

#include <support/ResidentMemory.h>

#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <cstdio>
#include <ctime>
#include <string>

using namespace osgLabels;

namespace
{

/// Of the processor: other programs may run beside.
double secondsSince(std::clock_t start)
{
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

osg::ref_ptr<osg::Geometry> makeBox()
{
    osg::ref_ptr<osg::Geometry> box = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUShort> quads = new osg::DrawElementsUShort(GL_QUADS);
    for (int side = 0; side < 6; ++side)
        for (int corner = 0; corner < 4; ++corner)
        {
            osg::Vec3 normal, vertex;
            normal[side / 2] = side % 2 ? 1.0f : -1.0f;
            vertex = normal;
            vertex[(side / 2 + 1) % 3] = corner == 1 || corner == 2 ? 1.0f : -1.0f;
            vertex[(side / 2 + 2) % 3] = corner / 2 ? 1.0f : -1.0f;
            quads->push_back(static_cast<GLushort>(vertices->size()));
            vertices->push_back(vertex);
            normals->push_back(normal);
        }
    box->setVertexArray(vertices);
    box->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    box->addPrimitiveSet(quads);
    return box;
}

void measure(int count, bool isShared)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    osg::ref_ptr<osg::Geometry> shared = makeBox();
    std::vector<std::pair<const osg::Drawable*, osg::Matrixd>> leaves;
    for (int i = 0; i < count; ++i)
    {
        const auto matrix =
            osg::Matrixd::translate(3.0 * (i % 100), 3.0 * (i / 100 % 100), 3.0 * (i / 10000));
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
        transform->setName("P-" + std::to_string(i));
        osg::ref_ptr<osg::Geometry> box = isShared ? shared : makeBox();
        transform->addChild(box);
        group->addChild(transform);
        leaves.emplace_back(box.get(), matrix);
    }
    std::string error;
    auto table = std::make_shared<LabelTable>();
    LabelCollector collector(table, LabelSource::create({}, error),
                             [](const std::string& text)
                             { return LabelTable::Codes(text.begin(), text.end()); });
    const double before = support::residentMiB();
    auto start = std::clock();
    collector.collect(*group);
    const double collected = secondsSince(start);
    const double memory = support::residentMiB() - before;

    const auto groupToEye = osg::Matrixd::rotate(1.0, osg::Vec3d(1, 2, 3));
    start = std::clock();
    std::uint64_t sum = 0;
    {
        LabelCollector::View view(collector, *group, groupToEye);
        for (const auto& [drawable, matrix] : leaves)
            sum += view.find(*drawable, matrix * groupToEye);
    }
    const double found = secondsSince(start);
    start = std::clock();
    collector.sweep(*group, 1000);
    const double swept = secondsSince(start);

    const double beforeChunks = support::residentMiB();
    start = std::clock();
    Chunker chunker([&](const osg::NodePath& path) { return collector.getObject(*group, path); });
    const Chunks chunks = chunker.chunk(*group);
    std::printf(
        "%d %s boxes: collected in %.3f s (%.1f MiB), found at %.0f ns a leaf%s, 1000 swept "
        "in %.3f ms; %zu chunks in %.3f s (%.1f MiB)\n",
        count, isShared ? "instanced" : "single", collected, memory, 1e9 * found / count,
        sum == std::uint64_t(count) * (std::uint64_t(count) + 1) / 2 ? "" : " WRONG", 1e3 * swept,
        chunks.chunks, secondsSince(start), support::residentMiB() - beforeChunks);
}

} // namespace

int main()
{
    for (const int count : {10'000, 100'000, 300'000})
        for (const bool isShared : {false, true})
            measure(count, isShared);
}
