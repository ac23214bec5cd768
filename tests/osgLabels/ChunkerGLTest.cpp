// SPDX-License-Identifier: MIT
#include <osgLabels/Chunker.h>
#include <osgLabels/LabelCollector.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/LOD>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/ShadeModel>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgUtil/Optimizer>

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <set>

using namespace osgLabels;

namespace
{

constexpr int Width = 320, Height = 240;

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer made;
    return made;
}

/// Numbers objects by the order in which they are asked for.
struct Numbers
{
    std::uint32_t last = 0;
    Chunker::ObjectOf function()
    {
        return [this](const osg::NodePath&) { return ++last; };
    }
};

osg::ref_ptr<osg::Geometry> makeMesh(GLenum mode, std::mt19937& random, bool isColored)
{
    // A crooked ring of 2 x 9 vertices that all modes can draw.
    std::uniform_real_distribution<float> any(-0.2f, 0.2f);
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (int i = 0; i < 9; ++i)
        for (const float z : {-0.5f, 0.5f})
        {
            const float angle = static_cast<float>(i * osg::PI / 4.0);
            const osg::Vec3 out(std::cos(angle), std::sin(angle), 0.0f);
            vertices->push_back(out + osg::Vec3(0, 0, z + any(random)));
            normals->push_back(out);
            colors->push_back(osg::Vec4(0.5f + any(random), 0.5f + any(random), 0.7f, 1.0f));
        }
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    if (isColored)
        geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    else
    {
        colors->resize(1);
        geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
    }
    if (mode == GL_TRIANGLES)
    {
        osg::ref_ptr<osg::DrawElementsUByte> triangles = new osg::DrawElementsUByte(mode);
        for (GLubyte i = 0; i + 2 < 18; ++i)
            for (const GLubyte corner : {0, 1, 2})
                triangles->push_back(static_cast<GLubyte>(i + corner));
        geometry->addPrimitiveSet(triangles);
    }
    else if (mode == GL_POLYGON || mode == GL_TRIANGLE_FAN)
        geometry->addPrimitiveSet(new osg::DrawArrays(mode, 2, 4));
    else
        geometry->addPrimitiveSet(new osg::DrawArrays(mode, 0, mode == GL_QUADS ? 16 : 18));
    return geometry;
}

osg::Matrixd anyMatrix(std::mt19937& random)
{
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    return osg::Matrixd::scale(1.0 + 0.5 * any(random), (random() % 2 ? 1 : -1) * 0.8,
                               1.0 + 0.5 * any(random)) *
           osg::Matrixd::rotate(3.0 * any(random), osg::Vec3d(any(random), any(random), 1.0)) *
           osg::Matrixd::translate(any(random) * 8, any(random) * 8, any(random) * 8);
}

/// Many small Drawables under transforms, of several kinds of state.
osg::ref_ptr<osg::Group> makePlant(std::mt19937& random, const osg::Vec3d& place)
{
    osg::ref_ptr<osg::MatrixTransform> plant =
        new osg::MatrixTransform(osg::Matrixd::translate(place));
    osg::ref_ptr<osg::Geometry> shared = makeMesh(GL_QUAD_STRIP, random, true);
    const GLenum modes[] = {GL_TRIANGLES,  GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN,
                            GL_QUAD_STRIP, GL_QUADS,          GL_POLYGON};
    for (int i = 0; i < 300; ++i)
    {
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(anyMatrix(random));
        osg::ref_ptr<osg::Geometry> mesh = i % 5 ? makeMesh(modes[i % 6], random, i % 2) : shared;
        transform->addChild(mesh);
        transform->getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
        if (i % 7 == 0)
        {
            osg::ref_ptr<osg::Material> material = new osg::Material;
            material->setDiffuse(osg::Material::FRONT_AND_BACK,
                                 osg::Vec4(0.2f * float(i % 3), 0.5f, 0.5f, 1.0f));
            transform->getStateSet()->setAttribute(material);
        }
        if (i % 5 < 2)
            transform->getStateSet()->setAttribute(new osg::ShadeModel(osg::ShadeModel::FLAT));
        if (i % 7 < 3)
            transform->getStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::ON);
        plant->addChild(transform);
    }
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(plant);
    return group;
}

/// Chunks of all children of `model`, drawn and compared with the model itself.
Chunks expectSamePicture(osg::Group& model, const std::string& name, std::size_t chunkVertices,
                         const support::CompareImage& compare)
{
    Numbers numbers;
    Chunker chunker(numbers.function());
    chunker.setChunkVertices(chunkVertices);
    Chunks chunks = chunker.chunk(model);
    chunks.node->setStateSet(model.getStateSet());
    const auto camera = support::CameraSpec::overview(model, double(Width) / Height);
    const auto before = viewer().render(&model, camera, Width, Height);
    const auto after = viewer().render(chunks.node, camera, Width, Height);
    EXPECT_TRUE(compare(after, before, name));
    return chunks;
}

} // namespace

TEST(ChunkerGLTest, picturesOfAPlantStayTheSame)
{
    OSGKITS_NEED_GL(viewer());
    std::mt19937 random(3);
    // The second one far from the origin: places are in double precision, chunks about their own.
    for (const osg::Vec3d& place : {osg::Vec3d(), osg::Vec3d(1e7, -1e7, 1e6)})
        for (const std::size_t chunkVertices : {100u, 1000u, 65536u})
        {
            const auto plant = makePlant(random, place);
            // Vertices are rounded anew: pixels on edges may belong to the other triangle.
            support::CompareImage compare;
            compare.threshold = 1.0 / 255.0;
            compare.share = 0.001;
            compare.hardLimit = 1.0;
            const Chunks chunks = expectSamePicture(
                *plant, "chunks" + std::to_string(chunkVertices) + (place.x() > 0 ? "far" : ""),
                chunkVertices, compare);
            EXPECT_EQ(chunks.drawables, 300u);
            EXPECT_EQ(chunks.gathered, 300u);
            EXPECT_EQ(chunks.objects.size(), 300u);
            EXPECT_LT(chunks.chunks, 120u);
        }
}

TEST(ChunkerGLTest, picturesOfInventorModelsStayTheSame)
{
    OSGKITS_NEED_GL(viewer());
    viewer().setFailOnGLErrors(false); // text.iv raises some as it is
    std::size_t models = 0, gathered = 0, drawables = 0;
    for (const std::string& path : support::inventorModels())
    {
        osg::ref_ptr<osg::Node> model;
        {
            support::NotifyCapture quiet(osg::WARN);
            model = osgDB::readRefNodeFile(path);
            quiet.takeWarnings();
        }
        if (!model)
            continue;
        osg::ref_ptr<osg::Group> group = new osg::Group;
        group->addChild(model);
        support::CompareImage compare;
        compare.threshold = 1.0 / 255.0;
        // Edges as above, and surfaces in one plane, which may be drawn in another order.
        compare.share = 0.002;
        compare.hardLimit = 1.0;
        const Chunks chunks = expectSamePicture(
            *group, "chunks-" + std::filesystem::path(path).stem().string(), 65536, compare);
        std::cout << std::filesystem::path(path).filename().string() << ": " << chunks.gathered
                  << " of " << chunks.drawables << " in " << chunks.chunks << " chunks";
        for (const auto& [why, count] : chunks.leftOut)
            std::cout << ", " << count << " " << why;
        std::cout << "\n";
        ++models;
        gathered += chunks.gathered;
        drawables += chunks.drawables;
    }
    viewer().setFailOnGLErrors(true);
    if (!models)
        GTEST_SKIP() << "NOT TESTED: inventor-data is not installed";
    EXPECT_GT(2 * gathered, drawables);
}

TEST(ChunkerGLTest, shadersSeeTheObjectAtEachVertex)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (int i = 0; i < 4; ++i)
    {
        osg::ref_ptr<osg::MatrixTransform> transform =
            new osg::MatrixTransform(osg::Matrixd::translate(i % 2 - 1.0, i / 2 - 1.0, 0.0));
        transform->addChild(
            osg::createTexturedQuadGeometry(osg::Vec3(), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 0)));
        group->addChild(transform);
    }
    Chunker chunker([&](const osg::NodePath& path)
                    { return 16777217u + group->getChildIndex(path[1]); });
    const Chunks chunks = chunker.chunk(*group);
    EXPECT_EQ(chunks.chunks, 1u);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, R"(#version 330 compatibility
layout(location = 6) in int object;
flat out int number;
void main() { gl_Position = ftransform(); number = object; })"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, R"(#version 330 compatibility
flat in int number;
void main() { gl_FragColor = vec4(float(number - 16777216) * 10.0 / 255.0, 0.0, 0.0, 1.0); })"));
    chunks.node->getOrCreateStateSet()->setAttribute(program);
    const support::CameraSpec flat = {osg::Matrixd(), osg::Matrixd::ortho(-1, 1, -1, 1, -1, 1)};
    const auto image = viewer().render(chunks.node, flat, 64, 64);
    ASSERT_TRUE(image);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(std::lround(image->getColor(16 + 32 * (i % 2), 16 + 32 * (i / 2)).r() * 255.0f),
                  10 * (i + 1));
}

TEST(ChunkerGLTest, whatMayChangeIsNotGathered)
{
    std::mt19937 random(1);
    const auto with = [&](const std::function<void(osg::MatrixTransform&, osg::Geometry&)>& f)
    {
        osg::ref_ptr<osg::Group> group = new osg::Group;
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
        osg::ref_ptr<osg::Geometry> mesh = makeMesh(GL_TRIANGLES, random, true);
        transform->addChild(mesh);
        group->addChild(transform);
        f(*transform, *mesh);
        Numbers numbers;
        const Chunks chunks = Chunker(numbers.function()).chunk(*group);
        // What is not gathered is drawn as it is: the very same node.
        EXPECT_TRUE(chunks.gathered || chunks.node->getChild(0) == transform);
        EXPECT_EQ(chunks.leftOut.size(), chunks.gathered ? 0u : 1u);
        return chunks.gathered ? "gathered" : chunks.leftOut.begin()->first;
    };
    EXPECT_EQ(with([](auto&, auto&) {}), "gathered");
    EXPECT_EQ(with([](auto& t, auto&) { t.setDataVariance(osg::Object::DYNAMIC); }), "dynamic");
    EXPECT_EQ(with([](auto&, auto& g) { g.setDataVariance(osg::Object::DYNAMIC); }), "dynamic");
    EXPECT_EQ(with([](auto& t, auto&) { t.setUpdateCallback(new osg::NodeCallback); }),
              "callbacks");
    EXPECT_EQ(with([](auto&, auto& g) { g.setCullCallback(new osg::NodeCallback); }), "callbacks");
    EXPECT_EQ(with([](auto& t, auto&) { t.setNodeMask(1); }), "node masks");
    EXPECT_EQ(with([](auto& t, auto&) { t.setReferenceFrame(osg::Transform::ABSOLUTE_RF); }),
              "other kinds of nodes");
    EXPECT_EQ(with([](auto&, auto& g)
                   { g.getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON); }),
              "order of drawing");
    EXPECT_EQ(with([](auto& t, auto&)
                   { t.getOrCreateStateSet()->setDataVariance(osg::Object::DYNAMIC); }),
              "dynamic");
    EXPECT_EQ(with(
                  [](auto& t, auto&)
                  {
                      osg::ref_ptr<osg::Program> program = new osg::Program;
                      program->addShader(new osg::Shader(osg::Shader::FRAGMENT));
                      t.getOrCreateStateSet()->setAttribute(program);
                  }),
              "programs");
    EXPECT_EQ(with([](auto& t, auto&) { t.setMatrix(osg::Matrixd::scale(1, 0, 1)); }),
              "singular matrices");
    EXPECT_EQ(with([](auto&, auto& g) { g.addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, 2)); }),
              "other arrays or primitives than of surfaces");
    EXPECT_EQ(
        with([](auto&, auto& g) { g.addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 17, 3)); }),
        "other arrays or primitives than of surfaces");
}

TEST(ChunkerGLTest, whatIsNotGatheredStaysWhereItWas)
{
    OSGKITS_NEED_GL(viewer());
    std::mt19937 random(9);
    const auto plant = makePlant(random, {});
    osg::Group& inner = *plant->getChild(0)->asGroup();
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(makeMesh(GL_QUAD_STRIP, random, true), 0.0f, 1e10f);
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(anyMatrix(random));
    moved->addChild(lod);
    moved->addChild(makeMesh(GL_TRIANGLES, random, true));
    inner.addChild(moved);
    support::CompareImage compare;
    compare.threshold = 1.0 / 255.0;
    compare.share = 0.001;
    compare.hardLimit = 1.0;
    const Chunks chunks = expectSamePicture(*plant, "chunksAndLOD", 65536, compare);
    EXPECT_EQ(chunks.gathered, 301u);
    EXPECT_EQ(lod->getNumParents(), 2u);
    EXPECT_EQ(inner.getNumChildren(), 301u); // the model is as it was
}

TEST(ChunkerGLTest, equalStateBecomesOneChunkAndOtherStateAnother)
{
    std::mt19937 random(2);
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (int i = 0; i < 100; ++i)
    {
        osg::ref_ptr<osg::Geometry> mesh = makeMesh(GL_TRIANGLES, random, true);
        osg::ref_ptr<osg::Material> material = new osg::Material; // each has its own
        material->setDiffuse(osg::Material::FRONT, osg::Vec4(float(i % 4) / 4.0f, 0, 0, 1));
        mesh->getOrCreateStateSet()->setAttributeAndModes(material);
        group->addChild(mesh);
    }
    Numbers numbers;
    const Chunks chunks = Chunker(numbers.function()).chunk(*group);
    EXPECT_EQ(chunks.chunks, 4u);
    EXPECT_EQ(chunks.vertices, 1800u);
}

TEST(ChunkerGLTest, coloursThatTheMaterialFollowsNeedNoChunkOfTheirOwn)
{
    OSGKITS_NEED_GL(viewer());
    std::mt19937 random(2);
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (int i = 0; i < 60; ++i)
    {
        // As Inventor's reader does: the colour of the shape and that of its material agree.
        osg::ref_ptr<osg::Geometry> mesh = makeMesh(GL_TRIANGLES, random, false);
        osg::ref_ptr<osg::Material> material = new osg::Material;
        const osg::Vec4 color(float(i % 4) / 4.0f, float(i % 3) / 3.0f, 0.5f, 1.0f);
        material->setColorMode(osg::Material::DIFFUSE);
        material->setDiffuse(osg::Material::FRONT_AND_BACK, color);
        material->setShininess(osg::Material::FRONT_AND_BACK, i % 2 ? 10.0f : 20.0f);
        static_cast<osg::Vec4Array&>(*mesh->getColorArray())[0] = color;
        mesh->getOrCreateStateSet()->setAttributeAndModes(material);
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(anyMatrix(random));
        transform->addChild(mesh);
        group->addChild(transform);
    }
    support::CompareImage compare;
    compare.threshold = 1.0 / 255.0;
    compare.hardLimit = 1.0;
    const Chunks chunks = expectSamePicture(*group, "chunksOfColours", 65536, compare);
    EXPECT_EQ(chunks.gathered, 60u);
    EXPECT_EQ(chunks.chunks, 2u);
}

TEST(ChunkerGLTest, objectsAreThoseOfTheCollector)
{
    std::mt19937 random(4);
    osg::ref_ptr<osg::Group> group = new osg::Group;
    osg::ref_ptr<osg::Geometry> shared = makeMesh(GL_TRIANGLES, random, true);
    for (int i = 0; i < 50; ++i)
    {
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(anyMatrix(random));
        if (i % 5)
            transform->setName("T" + std::to_string(i));
        transform->addChild(i % 2 ? shared : makeMesh(GL_TRIANGLES, random, true));
        group->addChild(transform);
    }
    std::string error;
    LabelCollector collector(std::make_shared<LabelTable>(), LabelSource::create({}, error),
                             [](const std::string& text)
                             { return LabelTable::Codes(text.begin(), text.end()); });
    collector.collect(*group);
    Chunker chunker([&](const osg::NodePath& path) { return collector.getObject(*group, path); });
    const Chunks chunks = chunker.chunk(*group);
    EXPECT_EQ(chunks.gathered, 50u);
    ASSERT_EQ(chunks.objects.size(), 40u);
    std::set<std::uint32_t> numbers;
    for (const Chunks::Object& object : chunks.objects)
    {
        numbers.insert(object.object);
        const auto stored = collector.getObject(object.object);
        EXPECT_EQ(stored.drawable, object.geometry);
        const auto path = collector.getNodePath(*group, stored.identifier);
        ASSERT_EQ(path.size(), 2u);
        const osg::Matrixd& expected = static_cast<osg::MatrixTransform*>(path[1])->getMatrix();
        // The chunk's frame is the group's, moved.
        EXPECT_LT((expected.getScale() - object.localToChunk.getScale()).length(), 1e-9);
    }
    EXPECT_EQ(numbers.size(), 40u);
}
