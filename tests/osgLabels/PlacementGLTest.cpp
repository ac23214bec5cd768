// SPDX-License-Identifier: MIT
#include "PlacedShapes.h"

#include <osgLabels/Placement.h>

#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/Texture2D>
#include <osgDB/FileUtils>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <random>

using namespace osgLabels;

namespace
{

constexpr char Uniforms[] = R"glsl(
uniform vec4 rotation;
uniform vec3 origin;
uniform int shape;
uniform vec3 size;
uniform float width;

osgLabels_Object object()
{
    return osgLabels_Object(rotation, origin, uint(shape), size, 1u);
}
)glsl";

/// Letters that are neither symmetric nor the same upside down, on a plate; the first is red.
constexpr char Letters[] = R"glsl(
in vec3 local;
uniform vec3 worldUp;

bool ink(vec2 at)
{
    vec2 p = vec2(fract(at.x), at.y);
    bool stem = p.x > 0.2 && p.x < 0.36 && p.y > 0.15 && p.y < 0.9;
    bool top = p.x > 0.2 && p.x < 0.85 && p.y > 0.75 && p.y < 0.9;
    bool bar = p.x > 0.2 && p.x < 0.65 && p.y > 0.45 && p.y < 0.58;
    return stem || top || bar;
}

void main()
{
    mat4 inverseView = gl_ModelViewMatrixInverse;
    osgLabels_View view;
    view.eye = vec4(inverseView[3].xyz - origin, 1.0);
    view.up = worldUp;
    view.screenUp = inverseView[1].xyz;
    view.screenRight = inverseView[0].xyz;
    view.height = 0.5;
    view.gap = 2.0;
    view.base = vec3(0.0);
    vec3 dx = dFdx(local), dy = dFdy(local);
    osgLabels_Place at = osgLabels_placeOn(object(), local - origin, dx, dy, view, width);
    vec3 normal = normalize(gl_NormalMatrix * cross(dx, dy));
    vec3 color = vec3(0.35 + 0.5 * abs(normal.z));
    if (at.inside)
        color = ink(at.place) ? (at.place.x < 1.0 ? vec3(0.9, 0.0, 0.0) : vec3(0.0, 0.0, 0.3))
                              : mix(color, vec3(1.0, 1.0, 0.3), 0.6);
    gl_FragData[0] = vec4(color, 1.0);
}
)glsl";

constexpr char LettersVertex[] = R"glsl(#version 330 compatibility
out vec3 local;
void main()
{
    local = gl_Vertex.xyz;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)glsl";

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

osg::ref_ptr<osg::Program> programOf(const char* vertex, const char* fragment)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT,
                        "#version 330 compatibility\n" + placementSource() + Uniforms + fragment));
    return program;
}

osg::Vec3 vec(const glm::vec3& v)
{
    return osg::Vec3(v.x, v.y, v.z);
}

void setObject(osg::StateSet* state, const ObjectRecord& record, float width)
{
    const glm::quat& q = record.rotation;
    state->addUniform(new osg::Uniform("rotation", osg::Vec4(q.x, q.y, q.z, q.w)));
    state->addUniform(new osg::Uniform("origin", vec(record.origin)));
    state->addUniform(new osg::Uniform("shape", int(record.shape)));
    state->addUniform(new osg::Uniform("size", vec(record.size)));
    state->addUniform(new osg::Uniform("width", width));
}

class PlacementGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    static support::HeadlessSettings settings()
    {
        support::HeadlessSettings large;
        large.width = large.height = 256;
        return large;
    }

    support::HeadlessViewer _viewer{settings()};
};

void copyTile(const osg::Image& tile, osg::Image& sheet, int column, int row)
{
    for (int y = 0; y != tile.t(); ++y)
        std::memcpy(sheet.data(column * tile.s(), sheet.t() - (row + 1) * tile.t() + y),
                    tile.data(0, y), std::size_t(4 * tile.s()));
}

/// A picture of all shapes, a column for each of the directions that they are seen from.
osg::ref_ptr<osg::Image> contactSheet(support::HeadlessViewer& viewer,
                                      const std::vector<osg::Vec3d>& from,
                                      const osg::Matrixd& placed, std::size_t first,
                                      std::size_t count)
{
    constexpr int Side = 256;
    const std::vector<PlacedShape> shapes = placedShapes();
    count = std::min(count, shapes.size() - first);
    osg::ref_ptr<osg::Image> sheet = new osg::Image;
    sheet->allocateImage(Side * int(from.size()), Side * int(count), 1, GL_RGBA, GL_UNSIGNED_BYTE);
    osg::ref_ptr<osg::Program> program = programOf(LettersVertex, Letters);
    for (std::size_t i = 0; i != count; ++i)
        for (std::size_t k = 0; k != from.size(); ++k)
        {
            const PlacedShape& shape = shapes[first + i];
            osg::ref_ptr<osg::MatrixTransform> root = new osg::MatrixTransform(placed);
            root->addChild(geometryOf(shape.mesh));
            osg::StateSet* state = root->getOrCreateStateSet();
            state->setAttributeAndModes(program);
            setObject(state, shape.mesh.truth.record(1), shape.width);
            const osg::Matrixd inverse = osg::Matrixd::inverse(placed);
            state->addUniform(new osg::Uniform(
                "worldUp", osg::Vec3(osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), inverse))));
            const double radius = root->getBound().radius();
            const osg::Vec3d center = root->getBound().center();
            const auto camera = support::CameraSpec::perspective(center + from[k] * radius * 2.6,
                                                                 center, osg::Vec3d(0, 0, 1), 46, 1,
                                                                 0.1 * radius, 10 * radius);
            const auto tile = viewer.render(root, camera, Side, Side);
            if (tile)
                copyTile(*tile, *sheet, int(k), int(i));
        }
    return sheet;
}

} // namespace

TEST_F(PlacementGLTest, everyShapeHasReadableText)
{
    osgDB::makeDirectory("images");
    const std::vector<osg::Vec3d> from = {osg::Vec3d(0.3, -1, 0.35), osg::Vec3d(1, -0.2, 0.5),
                                          osg::Vec3d(-0.6, 0.7, 0.2), osg::Vec3d(0.2, -0.3, 1),
                                          osg::Vec3d(0.4, -0.6, -0.7)};
    const osg::Matrixd turned =
        osg::Matrixd::rotate(osg::PI_2, 0, 1, 0) * osg::Matrixd::rotate(0.4, 0, 0, 1);
    for (std::size_t first = 0; first < placedShapes().size(); first += 7)
    {
        const std::string name = "images/placement" + std::to_string(first / 7);
        osgDB::writeImageFile(*contactSheet(_viewer, from, osg::Matrixd(), first, 7),
                              name + ".png");
        osgDB::writeImageFile(*contactSheet(_viewer, from, turned, first, 7), name + "turned.png");
    }
}
