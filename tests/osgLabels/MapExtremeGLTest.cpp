// SPDX-License-Identifier: MIT
// Map labels where they are hard to draw.
#include "MapPictures.h"

#include <support/NotifyCapture.h>

#include <osg/MatrixTransform>

#include <limits>

using namespace mapScene;

namespace
{

class MapExtreme : public MapTest
{
};

int whole(const std::string& text, const osg::Vec3d& anchor,
          const support::CameraSpec& camera = labelScene::fromFront())
{
    return redPixels(*render(*scene({label(text, anchor)}), camera));
}

/// Four walls around a yard open at the top, one closed mesh: a box with a square hole along z.
osg::ref_ptr<osg::Geode> courtyard(const std::string& name)
{
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const float z : {-0.5f, 0.5f})
        for (const float r : {0.8f, 0.4f})
            for (const osg::Vec2& c : {osg::Vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
                corners->push_back(osg::Vec3(c.x() * r, c.y() * r, z));
    osg::ref_ptr<osg::DrawElementsUShort> quads = new osg::DrawElementsUShort(GL_QUADS);
    const auto quad = [&](unsigned a, unsigned b, unsigned c, unsigned d)
    {
        for (const unsigned corner : {a, b, c, d})
            quads->push_back(GLushort(corner));
    };
    for (unsigned i = 0; i < 4; ++i)
    {
        const unsigned j = (i + 1) % 4;
        quad(i, j, 8 + j, 8 + i);           // outer walls
        quad(4 + j, 4 + i, 12 + i, 12 + j); // of the yard
        quad(8 + i, 8 + j, 12 + j, 12 + i); // roof
        quad(j, i, 4 + i, 4 + j);           // floor
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(corners);
    const osg::Vec4 color(0.7f, 0.7f, 0.6f, 1);
    geometry->setColorArray(new osg::Vec4Array(1, &color), osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(quads);
    return labelScene::named(name, geometry);
}

} // namespace

TEST_F(MapExtreme, featuresThatShareAWallHideEachOthersLabelsOnlyFromBeforeIt)
{
    // Both have the wall y = 0; the anchor is on it and on either side.
    const auto front = box("front", {0, -0.3f, 0}, {0.5f, 0.3f, 0.5f});
    const auto back = box("back", {0, 0.3f, 0}, {0.5f, 0.3f, 0.5f});
    const auto pixels = [&](double y, const std::string& own) {
        return redPixels(*render(*scene({front, back, label("wall", {0, y, 0}, own)})));
    };
    const int all = whole("wall", {0, 0, 0});
    EXPECT_EQ(pixels(0.0, "front"), all);
    EXPECT_EQ(pixels(0.0, "back"), all) << "on the wall it is not behind it";
    EXPECT_EQ(pixels(-0.1, "back"), all);
    EXPECT_EQ(pixels(0.1, "back"), 0);
    EXPECT_EQ(pixels(0.1, "front"), all);
}

TEST_F(MapExtreme, featuresWithoutBackFacesHideByBothSides)
{
    const auto wall = sheet("wall", {-1, -1, -1}, {2, 0, 0}, {0, 0, 2});
    EXPECT_EQ(redPixels(*render(*scene({wall, label("text", {0, 0, 0}, "wall")}))),
              whole("text", {0, 0, 0}));
    EXPECT_EQ(redPixels(*render(*scene({wall, label("text", {0, 0, 0}, "no such")}))), 0);
}

TEST_F(MapExtreme, courtyardsSeeTheirOwnLabelsOnly)
{
    const auto yard = courtyard("yard");
    const osg::Vec3d inside(0, 0, 0);
    const auto own = scene({yard, label("yard", inside, "yard")});
    EXPECT_EQ(redPixels(*render(*own)), whole("yard", inside));
    EXPECT_EQ(redPixels(*render(*scene({yard, label("yard", inside)}))), 0)
        << "its front wing stands before the yard";
    EXPECT_EQ(redPixels(*render(*scene({yard, label("yard", {0, -0.6, 0})}))),
              whole("yard", {0, -0.6, 0}))
        << "in the wing";
}

TEST_F(MapExtreme, theCameraMayBeInsideOfAFeature)
{
    const auto around = box("around", {0, 0, 0}, {3, 5, 3});
    EXPECT_EQ(redPixels(*render(*scene({around, label("text", {0, 0, 0})}))),
              whole("text", {0, 0, 0}))
        << "inside too";
    EXPECT_EQ(redPixels(*render(*scene({around, label("text", {0, 6, 0})}))), 0)
        << "behind its wall";
    EXPECT_EQ(redPixels(*render(*scene({around, label("text", {0, 6, 0}, "around")}))),
              whole("text", {0, 6, 0}));
}

TEST_F(MapExtreme, labelsBehindTheEyeAreNotThere)
{
    for (const double y : {-4.0, -4.0001, -5.0, -1e30})
    {
        const auto top = scene({label("text", {0, y, 0}), label("other", {0, 0, 0})});
        EXPECT_EQ(redPixels(*render(*top)), whole("other", {0, 0, 0})) << y;
    }
}

TEST_F(MapExtreme, nearPlanesDoNotCutLabels)
{
    // The near plane is 0.5 from the eye, at y = -3.5.
    for (const double y : {-3.4, -3.5, -3.6, -3.9})
    {
        const auto top = scene({label("near", {0, y, 0}), box("b", {0, 0, 0}, {1, 0.1f, 1})});
        EXPECT_EQ(redPixels(*render(*top)), whole("near", {0, 0, 0})) << y;
    }
    const auto wide = scene({label("near", {0, -3.499, 0})}, "mapworld=0.05");
    EXPECT_GT(redPixels(*render(*wide)), 500);
}

TEST_F(MapExtreme, labelsMayBeLargerThanTheScreen)
{
    const auto top = scene({label("W", {0, 0, 0})}, "mapworld=100");
    const Picture picture = render(*top);
    keep(picture, "map-large");
    EXPECT_EQ(redPixels(*picture), labelScene::Width * labelScene::Height);
    const auto close = scene({label("W", {0, -3.999999, 0})}, "mapworld=1e9");
    EXPECT_EQ(redPixels(*render(*close)), labelScene::Width * labelScene::Height);
}

TEST_F(MapExtreme, placesThatAreNoNumbersAreNamedAndNotShown)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    osg::ref_ptr<osgLabels::MapLabels> labels =
        new osgLabels::MapLabels({{{nan, 0, 0}, "a", 0, {}, {}},
                                  {{0, inf, 0}, "b", 0, {}, {}},
                                  {{0, 0, 0}, "c", nan, {}, {}},
                                  {{0, 0, 0}, "text", 0, {}, {}}});
    labels->setName("map");
    EXPECT_EQ(redPixels(*render(*scene({labels}))), whole("text", {0, 0, 0}));
    const support::NotifyCapture::Lines lines = _notify.takeWarnings();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("3 labels of node 'map'"), std::string::npos) << lines[0];
}

TEST_F(MapExtreme, farFromTheOriginAllIsAsHere)
{
    const osg::Vec3d away(1e7, -2e7, 3e6);
    const auto build = [](const std::string& name)
    {
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
        place->addChild(box(name, {0, 0, 0}, {0.5f, 0.3f, 0.5f}));
        place->addChild(box("before", {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}));
        return place;
    };
    const auto here = build("middle"), there = build("middle");
    there->setMatrix(osg::Matrixd::translate(away));
    support::CameraSpec camera = labelScene::fromFront();
    camera.view = osg::Matrixd::translate(-away) * camera.view;
    const Picture expected = render(*scene({here, label("half of it", {0, 0, 0}, "middle")}));
    const Picture actual = render(*scene({there, label("half of it", away, "middle")}), camera);
    keep(actual, "map-away");
    EXPECT_GT(redPixels(*expected), 100);
    // Places of pixels are those of doubles of 1e7, to 1e-8 units: edges move by nothing.
    EXPECT_TRUE(labelScene::areAlike(actual, expected, "map-away"));
}

TEST_F(MapExtreme, aHundredThousandLabelsAtOnePlace)
{
    std::vector<osgLabels::MapLabel> labels;
    for (int i = 0; i < 100000; ++i)
        labels.push_back({{0, 0, 0}, "text " + std::to_string(i % 1000), double(i % 7), {}, {}});
    labels.push_back({{0, 0, 0}, "first", 8, {}, {}});
    osg::ref_ptr<osgLabels::MapLabels> all = new osgLabels::MapLabels(labels);
    const auto top = scene({all}, "declutter=on");
    EXPECT_EQ(redPixels(*render(*top)), whole("first", {0, 0, 0}));
    EXPECT_EQ(countOf(*top, "map.labels"), 1);
    EXPECT_EQ(countOf(*top, "map.labels.inView"), 100001);
}

TEST_F(MapExtreme, mirroredAndTurnedInsideOutMeshesHideByWhereRaysLeave)
{
    for (const osg::Vec3d& scale : {osg::Vec3d(-1, 1, 1), {1, -1, 1}, {-1, -1, -1}})
    {
        osg::ref_ptr<osg::MatrixTransform> mirror = new osg::MatrixTransform;
        mirror->setMatrix(osg::Matrixd::scale(scale));
        mirror->addChild(box("mirrored", {0, 0, 0}, {0.5f, 0.3f, 0.5f}));
        const auto pixels = [&](double y) {
            return redPixels(*render(*scene({mirror, label("text", {0, y, 0})})));
        };
        EXPECT_EQ(pixels(0.2), whole("text", {0, 0.2, 0}));
        EXPECT_EQ(pixels(0.4), 0);
    }
    const auto yard = courtyard("turned");
    auto* quads = static_cast<osg::DrawElementsUShort*>(
        yard->getDrawable(0)->asGeometry()->getPrimitiveSet(0));
    for (std::size_t i = 0; i < quads->size(); i += 4)
        std::swap((*quads)[i + 1], (*quads)[i + 3]);
    EXPECT_EQ(redPixels(*render(*scene({yard, label("yard", {0, -0.6, 0})}))),
              whole("yard", {0, -0.6, 0}))
        << "in the wing";
    EXPECT_EQ(redPixels(*render(*scene({yard, label("yard", {0, 0, 0})}))), 0);
}

TEST_F(MapExtreme, parallelRaysHideInTheSameWay)
{
    const auto middle = box("middle", {0, 0, 0}, {0.5f, 0.3f, 0.5f});
    const auto pixels = [&](double y) {
        return redPixels(
            *render(*scene({middle, label("text", {0, y, 0})}), labelScene::parallel()));
    };
    const int all = whole("text", {0, 0, 0}, labelScene::parallel());
    EXPECT_EQ(pixels(-0.4), all);
    EXPECT_EQ(pixels(0.299), all);
    EXPECT_EQ(pixels(0.301), 0);
}
