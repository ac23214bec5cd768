// SPDX-License-Identifier: MIT
// Time of shadow volumes against the number of triangles, by technique, and their memory: one
// bumpy ball over a ground under one point light.
//
//   osgShadowVolume.ShadowTrianglesBenchmark [--size WxH] [--rounds N] [--most N] [--csv file]
//
// Milliseconds are those of a frame less those of the same frame with shadows off, the median of
// the differences in a round. "moving": the light has moved since the last frame, so what the CPU
// found before is of no use. Bytes are those of one edge: `mesh` in main memory, the rest on the
// GPU, vertices included.
#include <support/FrameTimer.h>

#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <osg/ArgumentParser>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightSource>

#include <algorithm>
#include <cmath>

using namespace osgShadowVolume;

namespace
{

enum Method
{
    OFF,
    TESS,
    GEOMETRY,
    CPU,
    NumMethods
};

/// A closed ball of radius about 1 around the origin, with bumps of a tenth of it.
osg::ref_ptr<osg::Geometry> makeBall(int triangles)
{
    const int rows = std::max(4, int(std::sqrt(triangles / 4.0))), columns = 2 * rows;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column < columns; ++column)
        {
            const double latitude = osg::PI * (double(row) / rows - 0.5);
            const double longitude = 2.0 * osg::PI * column / columns;
            // The poles are one point each.
            const double across = row == 0 || row == rows ? 0.0 : std::cos(latitude);
            const osg::Vec3 direction(across * std::cos(longitude), across * std::sin(longitude),
                                      std::sin(latitude));
            const double bump = across * std::sin(20.0 * longitude) * std::sin(20.0 * latitude);
            vertices->push_back(direction * float(1.0 + 0.1 * bump));
            normals->push_back(direction);
        }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
        {
            const unsigned int a = unsigned(row * columns + column);
            const unsigned int b = unsigned(row * columns + (column + 1) % columns);
            const unsigned int step = unsigned(columns);
            for (unsigned int corner : {a, b, b + step, a, b + step, a + step})
                indices->push_back(corner);
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals);
    geometry->addPrimitiveSet(indices);
    return geometry;
}

struct Candidate
{
    osg::ref_ptr<osg::Geometry> ball;
    osg::ref_ptr<osg::Light> light;
    osg::ref_ptr<ShadowedScene> scene[NumMethods];
    std::vector<double> resting[NumMethods], moving[NumMethods];
};

Candidate makeCandidate(int triangles)
{
    Candidate candidate;
    candidate.ball = makeBall(triangles);
    osg::ref_ptr<osg::Geode> content = new osg::Geode;
    content->addDrawable(candidate.ball);
    content->addDrawable(osg::createTexturedQuadGeometry({-6, -6, -1.5f}, {12, 0, 0}, {0, 12, 0}));
    candidate.light = new osg::Light(1);
    candidate.light->setDiffuse(osg::Vec4(1, 1, 1, 1));
    candidate.light->setPosition(osg::Vec4(1.5f, -1.0f, 4.0f, 1.0f));
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(candidate.light);
    for (int method = 0; method < NumMethods; ++method)
    {
        osg::ref_ptr<ShadowedScene>& scene = candidate.scene[method];
        scene = new ShadowedScene;
        scene->setLightScope(ShadowedScene::LightScope::ALL);
        scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
        scene->addChild(source);
        scene->addChild(content);
        scene->setShadows(method == OFF ? Shadows::OFF : Shadows::VOLUMES);
        static const Technique techniques[] = {Technique::AUTO, Technique::TESS,
                                               Technique::GEOMETRY, Technique::CPU};
        scene->setTechnique(techniques[method]);
    }
    return candidate;
}

double bytesOf(const osg::Geometry& geometry)
{
    double bytes = geometry.getVertexArray()->getTotalDataSize();
    for (unsigned int i = 0; i < geometry.getNumPrimitiveSets(); ++i)
        bytes += geometry.getPrimitiveSet(i)->getTotalDataSize();
    return bytes;
}

/// Bytes an edge: mesh, tess, geometry, cpu, caps.
std::vector<double> memoryOf(osg::Geometry& ball)
{
    const osg::ref_ptr<CasterMesh> mesh = CasterCache::instance()->get({&ball});
    const EdgeMesh& edgeMesh = mesh->getEdges();
    double edges = 0.0;
    double bytes = double(edgeMesh.vertices.size() * sizeof(glm::vec3) +
                          edgeMesh.triangles.size() * sizeof(glm::uvec3));
    for (const EdgeMesh::Group& group : edgeMesh.groups)
    {
        edges += double(group.indices.size()) / (2 + group.opposites);
        bytes += double(group.indices.size() * sizeof(group.indices[0]));
    }
    double patches = 0.0;
    for (const auto& geometry : mesh->getPatches())
        patches += bytesOf(*geometry);
    const double triangles = bytesOf(*mesh->getTriangles());
    std::vector<double> all = {bytes, patches, bytesOf(*mesh->getLines()),
                               double(mesh->getExtrudable()->getTotalDataSize()),
                               triangles -
                                   mesh->getTriangles()->getVertexArray()->getTotalDataSize()};
    for (double& value : all)
        value /= edges;
    return all;
}

void measure(FrameTimer& timer, Candidate& candidate, int round)
{
    const support::CameraSpec camera = support::CameraSpec::perspective(
        {-3.0, -9.0, 6.0}, {0, 0, -0.8}, {0, 0, 1}, 30.0, timer.getAspect(), 1.0, 40.0);
    double resting[NumMethods], moving[NumMethods];
    for (int method = 0; method < NumMethods; ++method)
    {
        resting[method] = timer.draw(*candidate.scene[method], camera).frame;
        moving[method] =
            timer
                .draw(*candidate.scene[method], camera,
                      [&]
                      {
                          const float shift = 0.01f * float(round * NumMethods + method);
                          candidate.light->setPosition(osg::Vec4(1.5f + shift, -1.0f, 4.0f, 1.0f));
                      })
                .frame;
    }
    for (int method = 0; round >= 0 && method < NumMethods; ++method)
    {
        candidate.resting[method].push_back(resting[method] - resting[OFF]);
        candidate.moving[method].push_back(moving[method] - moving[OFF]);
    }
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    int most = 1000000;
    arguments.read("--most", most);
    if (!options.read(arguments))
        return 2;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;
    std::vector<Candidate> candidates;
    for (int triangles = 1000; triangles <= most; triangles *= 10)
        candidates.push_back(makeCandidate(triangles));
    for (int round = -1; round < options.rounds; ++round)
        for (Candidate& candidate : candidates)
            measure(timer, candidate, round);
    Table table({"triangles", "tess_ms", "geometry_ms", "cpu_ms", "tess_moving_ms",
                 "geometry_moving_ms", "cpu_moving_ms", "mesh_bytes", "tess_bytes",
                 "geometry_bytes", "cpu_bytes", "caps_bytes"});
    for (const Candidate& candidate : candidates)
    {
        std::vector<double> row;
        for (const auto* times : {candidate.resting, candidate.moving})
            for (int method = TESS; method < NumMethods; ++method)
                row.push_back(median(times[method]));
        for (double bytes : memoryOf(*candidate.ball))
            row.push_back(bytes);
        table.add(std::to_string(candidate.ball->getPrimitiveSet(0)->getNumIndices() / 3), row);
    }
    return table.report(options.csv);
}
