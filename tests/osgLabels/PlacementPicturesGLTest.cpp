// SPDX-License-Identifier: MIT
// Text on every shape, seen from all around, can be read.
#include "PlacedShapes.h"
#include "PlacementShader.h"

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/MatrixTransform>
#include <osg/Program>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

using namespace osgLabels;
using namespace placementShader;

namespace
{

constexpr int Side = 256;

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

void copyTile(const osg::Image& tile, osg::Image& sheet, int column, int row)
{
    for (int y = 0; y != tile.t(); ++y)
        std::memcpy(sheet.data(column * tile.s(), sheet.t() - (row + 1) * tile.t() + y),
                    tile.data(0, y), std::size_t(4 * tile.s()));
}

/// Pixels of letters that are a text's first (red) and others.
glm::ivec2 countInk(const osg::Image& tile)
{
    glm::ivec2 count(0);
    for (int y = 0; y != tile.t(); ++y)
        for (int x = 0; x != tile.s(); ++x)
        {
            const unsigned char* pixel = tile.data(x, y);
            count.x += pixel[0] > 200 && pixel[1] < 20 && pixel[2] < 20;
            count.y += pixel[0] < 20 && pixel[1] < 20 && pixel[2] > 60;
        }
    return count;
}

/// A picture of all shapes, a column for each of the directions that they are seen from.
osg::ref_ptr<osg::Image> contactSheet(support::HeadlessViewer& viewer,
                                      const std::vector<osg::Vec3d>& from,
                                      const osg::Matrixd& placed, std::size_t first,
                                      std::size_t count)
{
    const std::vector<PlacedShape> shapes = placedShapes();
    count = std::min(count, shapes.size() - first);
    osg::ref_ptr<osg::Image> sheet = new osg::Image;
    sheet->allocateImage(Side * int(from.size()), Side * int(count), 1, GL_RGBA, GL_UNSIGNED_BYTE);
    osg::ref_ptr<osg::Program> program = programOf(LettersVertex, Letters);
    for (std::size_t i = 0; i != count; ++i)
    {
        const PlacedShape& shape = shapes[first + i];
        int readable = 0;
        for (std::size_t k = 0; k != from.size(); ++k)
        {
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
            if (!tile)
                continue;
            copyTile(*tile, *sheet, int(k), int(i));
            const glm::ivec2 ink = countInk(*tile);
            readable += ink.x > 4 && ink.y > 12;
        }
        // From straight above, a sphere's or a dish's text lies on the rim.
        EXPECT_GE(readable, int(from.size()) - 2) << shape.name;
    }
    return sheet;
}

} // namespace

TEST(PlacementPicturesGLTest, everyShapeHasReadableText)
{
    support::HeadlessViewer viewer({Side, Side});
    OSGKITS_NEED_GL(viewer);
    const std::vector<osg::Vec3d> from = {osg::Vec3d(0.3, -1, 0.35), osg::Vec3d(1, -0.2, 0.5),
                                          osg::Vec3d(-0.6, 0.7, 0.2), osg::Vec3d(0.2, -0.3, 1),
                                          osg::Vec3d(0.4, -0.6, -0.7)};
    const osg::Matrixd turned =
        osg::Matrixd::rotate(osg::PI_2, 0, 1, 0) * osg::Matrixd::rotate(0.4, 0, 0, 1);
    for (std::size_t first = 0; first < placedShapes().size(); first += 7)
    {
        const std::string name = "placement" + std::to_string(first / 7);
        const auto upright = contactSheet(viewer, from, osg::Matrixd(), first, 7);
        const auto lying = contactSheet(viewer, from, turned, first, 7);
        if (std::getenv("OSGKITS_KEEP_IMAGES"))
        {
            support::writeImage(*upright, name);
            support::writeImage(*lying, name + "turned");
        }
    }
}
