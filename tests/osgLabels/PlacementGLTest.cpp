// SPDX-License-Identifier: MIT
// The shader places as the CPU does.
#include "PlacedShapes.h"
#include "PlacementShader.h"

#include <support/HeadlessViewer.h>

#include <osg/Program>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace osgLabels;
using namespace placementShader;

namespace
{

/// Places points that textures hold.
constexpr char Points[] = R"glsl(
uniform sampler2D positions, right, up;
uniform vec4 eye;
uniform vec3 worldUp, screenUp, screenRight, base;
uniform bool footprints;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    osgLabels_View view;
    view.eye = eye;
    view.up = worldUp;
    view.screenUp = screenUp;
    view.screenRight = screenRight;
    view.height = 0.5;
    view.gap = 2.0;
    view.base = base;
    osgLabels_Place p = osgLabels_placeOn(object(), texelFetch(positions, at, 0).xyz,
                                          texelFetch(right, at, 0).xyz, texelFetch(up, at, 0).xyz,
                                          view, width);
    gl_FragData[0] = footprints ? vec4(p.footprint[0], p.footprint[1])
                                : vec4(p.place, p.inside ? 1.0 : 0.0, 1.0);
}
)glsl";

constexpr char PointsVertex[] = R"glsl(#version 330 compatibility
void main()
{
    gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
}
)glsl";

/// Points, steps and what the CPU makes of them.
struct Batch
{
    std::vector<glm::vec3> position, right, up;
    PlacementView view;
};

constexpr int BatchSide = 64;

/// Points about the surface of a mesh, with steps across the facets that they are from.
Batch randomBatch(const ShapeMesh& mesh, std::mt19937& random)
{
    std::uniform_real_distribution<double> unit;
    std::normal_distribution<double> gauss;
    const auto direction = [&]
    { return glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random))); };
    const double reach = std::max({mesh.truth.size.x, mesh.truth.size.y, mesh.truth.size.z});
    Batch batch;
    const glm::dvec3 eye = (2.0 + 3.0 * unit(random)) * reach * direction();
    const glm::dvec3 right = glm::normalize(glm::cross(eye, direction()));
    batch.view.eye = glm::vec4(glm::vec3(eye), 1.0f);
    batch.view.up = glm::vec3(direction());
    batch.view.screenRight = glm::vec3(right);
    batch.view.screenUp = glm::vec3(glm::normalize(glm::cross(eye, right)));
    batch.view.base = glm::vec3(0.3 * direction());
    while (batch.position.size() != std::size_t(BatchSide * BatchSide))
    {
        const std::size_t facet = 3 * (random() % (mesh.indices.size() / 3));
        const glm::dvec3 a = mesh.points[mesh.indices[facet]];
        const glm::dvec3 ab = mesh.points[mesh.indices[facet + 1]] - a;
        const glm::dvec3 ac = mesh.points[mesh.indices[facet + 2]] - a;
        // At the tips of cones and spheres there are facets of no area.
        if (glm::length(glm::cross(ab, ac)) < 1e-6)
            continue;
        const double u = unit(random), v = (1.0 - u) * unit(random);
        batch.position.push_back(
            glm::vec3(a + u * ab + v * ac - mesh.truth.origin - glm::dvec3(batch.view.base)));
        batch.right.push_back(glm::vec3(0.01 * (ab + unit(random) * ac)));
        batch.up.push_back(glm::vec3(0.01 * (ac - unit(random) * ab)));
    }
    return batch;
}

osg::ref_ptr<osg::Texture2D> textureOf(const std::vector<glm::vec3>& values)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(BatchSide, BatchSide, 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    auto* to = reinterpret_cast<float*>(image->data());
    for (const glm::vec3& value : values)
        for (const float x : {value.x, value.y, value.z, 0.0f})
            *to++ = x;
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

/// What the GPU makes of a batch, four floats a point.
std::vector<glm::vec4> placeOnGpu(support::HeadlessViewer& viewer, osg::Program* program,
                                  const Batch& batch, const ObjectRecord& record, float width,
                                  bool footprints)
{
    osg::ref_ptr<osg::Geometry> screen = osg::createTexturedQuadGeometry(
        osg::Vec3(-1, -1, 0), osg::Vec3(2, 0, 0), osg::Vec3(0, 2, 0));
    screen->setCullingActive(false);
    osg::StateSet* state = screen->getOrCreateStateSet();
    state->setAttributeAndModes(program);
    setObject(state, record, width);
    const char* names[] = {"positions", "right", "up"};
    const std::vector<glm::vec3>* values[] = {&batch.position, &batch.right, &batch.up};
    for (int i = 0; i != 3; ++i)
    {
        state->setTextureAttribute(unsigned(i), textureOf(*values[i]));
        state->addUniform(new osg::Uniform(names[i], i));
    }
    const glm::vec4& eye = batch.view.eye;
    state->addUniform(new osg::Uniform("eye", osg::Vec4(eye.x, eye.y, eye.z, eye.w)));
    state->addUniform(new osg::Uniform("worldUp", vec(batch.view.up)));
    state->addUniform(new osg::Uniform("screenUp", vec(batch.view.screenUp)));
    state->addUniform(new osg::Uniform("screenRight", vec(batch.view.screenRight)));
    state->addUniform(new osg::Uniform("base", vec(batch.view.base)));
    state->addUniform(new osg::Uniform("footprints", footprints));
    const auto image = viewer.renderFloat(
        screen, support::CameraSpec{osg::Matrixd(), osg::Matrixd()}, BatchSide, BatchSide);
    std::vector<glm::vec4> read;
    for (int i = 0; image && i != BatchSide * BatchSide; ++i)
    {
        const auto* at = reinterpret_cast<const float*>(image->data(i % BatchSide, i / BatchSide));
        read.emplace_back(at[0], at[1], at[2], at[3]);
    }
    return read;
}

} // namespace

TEST(PlacementGLTest, shaderAndCpuPlaceAlike)
{
    support::HeadlessViewer viewer({BatchSide, BatchSide});
    OSGKITS_NEED_GL(viewer);
    std::mt19937 random(11);
    osg::ref_ptr<osg::Program> program = programOf(PointsVertex, Points);
    double worst = 0.0, worstFootprint = 0.0;
    long points = 0, elsewhere = 0, insides = 0;
    for (const PlacedShape& shape : placedShapes())
        for (int view = 0; view != 3; ++view)
        {
            ShapeMesh mesh = shape.mesh;
            if (view > 0)
                mesh.move(glm::normalize(glm::dquat(0.3, 0.7, view, -0.2)), {3, 1, -2});
            const ObjectRecord record = mesh.truth.record(1);
            const Batch batch = randomBatch(mesh, random);
            const auto places = placeOnGpu(viewer, program, batch, record, shape.width, false);
            const auto steps = placeOnGpu(viewer, program, batch, record, shape.width, true);
            ASSERT_EQ(places.size(), batch.position.size());
            ASSERT_EQ(steps.size(), batch.position.size());
            for (std::size_t i = 0; i != places.size(); ++i)
            {
                const LabelPlace cpu = placeOn(record, batch.position[i], batch.right[i],
                                               batch.up[i], batch.view, shape.width);
                // Away from text it does not matter.
                if (cpu.place.y < -1.0f || cpu.place.y > 2.0f || cpu.place.x < -1.0f ||
                    cpu.place.x > shape.width + 1.0f)
                    continue;
                ++points;
                const double off = glm::distance(glm::vec2(places[i]), cpu.place);
                if (off > 0.01)
                {
                    ++elsewhere;
                    continue;
                }
                worst = std::max(worst, off);
                insides += cpu.inside != (places[i].z > 0.5f);
                const glm::vec4 footprint(cpu.footprint[0], cpu.footprint[1]);
                worstFootprint =
                    std::max(worstFootprint, double(glm::distance(footprint, steps[i]) /
                                                    std::max(glm::length(footprint), 1e-6f)));
            }
        }
    std::cout << points << " points, at most " << worst << " em and " << worstFootprint
              << " of the footprint apart; " << elsewhere << " on a neighbouring text or face, "
              << insides << " on its edge\n";
    // Functions of angles are the GPU's own; 2e-5 and 3e-6 were measured with Mesa 22.3.
    EXPECT_LT(worst, 1e-3);
    EXPECT_LT(worstFootprint, 1e-3);
    // A point between two texts or faces may belong to either.
    EXPECT_LT(elsewhere, points / 1000);
    EXPECT_LT(insides, points / 1000);
}
