// SPDX-License-Identifier: MIT
// What hides a map label and what does not.
#include "MapPictures.h"

#include <osg/MatrixTransform>

using namespace mapScene;

namespace
{

class MapLabels : public MapTest
{
};

/// A box seen in the middle, from y = -0.3 to 0.3.
osg::ref_ptr<osg::Geode> middle(const std::string& name = "middle")
{
    return box(name, {0, 0, 0}, {0.5f, 0.3f, 0.5f});
}

/// A box before the left half of the view, from y = -1.2 to -0.8.
osg::ref_ptr<osg::Geode> before(const std::string& name = "before")
{
    return box(name, {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}, {0.4f, 0.5f, 0.9f, 1});
}

/// Of the label alone; plates have edges, so that their place counts.
int whole(const std::string& text, const osg::Vec3d& anchor = osg::Vec3d())
{
    return redPixels(*render(*scene({label(text, anchor)})));
}

} // namespace

TEST_F(MapLabels, areShownAtTheirAnchors)
{
    const auto top = scene({label("ABC", {0.5, 0, 0.25})});
    const Picture picture = render(*top);
    ASSERT_TRUE(picture);
    keep(picture, "map-alone");
    // mapsize is the line's height: letters are cells of 0.5 to 0.7 em, plates have edges.
    const int pixels = redPixels(*picture);
    EXPECT_GT(pixels, 14 * 3 * 6);
    EXPECT_LT(pixels, 18 * 3 * 14);
    const osg::Vec2d at = pixelOf({0.5, 0, 0.25});
    const osg::Vec4 there = picture->getColor(unsigned(at.x()), unsigned(at.y()));
    EXPECT_EQ(there, osg::Vec4(1, 0, 0, 1));
    EXPECT_EQ(countOf(*top, "map.labels"), 1);
    EXPECT_EQ(countOf(*top, "map.bytes.targets"), 0) << "nothing stands before it";
}

TEST_F(MapLabels, areNeverHiddenByTheirOwnFeature)
{
    // The anchor is inside, on the far side of and behind the box.
    for (const double y : {0.0, 0.3, 2.0})
    {
        const auto own = scene({middle(), label("inside", {0, y, 0}, "middle")});
        EXPECT_EQ(redPixels(*render(*own)), whole("inside")) << y;
    }
}

TEST_F(MapLabels, areHiddenPixelByPixelByOtherFeatures)
{
    const auto both = scene({middle(), before(), label("half of it", {0, 0, 0}, "middle")});
    const Picture picture = render(*both);
    ASSERT_TRUE(picture);
    keep(picture, "map-half");
    const int left = redPixels(*picture, 0, labelScene::Width / 2);
    const int right = redPixels(*picture, labelScene::Width / 2, labelScene::Width);
    EXPECT_EQ(left, 0);
    EXPECT_NEAR(right, whole("half of it") / 2.0, 16) << "one column";
    EXPECT_EQ(countOf(*both, "map.occluders"), 1) << "the own feature takes no part";
}

TEST_F(MapLabels, areHiddenOnlyByWhatTheRayHasLeft)
{
    // Inside an unknown building, on it, behind it.
    const auto pixels = [](double y) {
        return redPixels(*render(*scene({middle(), label("text", {0, y, 0})})));
    };
    const int all = whole("text");
    EXPECT_EQ(pixels(-0.5), all);
    EXPECT_EQ(pixels(0.0), all);
    EXPECT_EQ(pixels(0.299), all);
    EXPECT_EQ(pixels(0.301), 0);
}

TEST_F(MapLabels, areHiddenByBothSidesOfOpenSheets)
{
    const auto wall = sheet("wall", {-1, -0.5f, -1}, {2, 0, 0}, {0, 0, 2});
    const auto turned = sheet("wall", {1, -0.5f, -1}, {-2, 0, 0}, {0, 0, 2});
    for (const auto& node : {wall, turned})
    {
        EXPECT_EQ(redPixels(*render(*scene({node, label("text", {0, 0, 0})}))), 0);
        EXPECT_EQ(redPixels(*render(*scene({node, label("text", {0, -0.6, 0})}))), whole("text"));
        EXPECT_EQ(redPixels(*render(*scene({node, label("text", {0, 0, 0}, "wall")}))),
                  whole("text"))
            << "its own";
    }
}

TEST_F(MapLabels, areHiddenByForeignFeaturesBehindTheirOwn)
{
    // The eye's ray leaves the own feature first, then the other one, then comes the anchor.
    const auto far = box("far", {0, 1, 0}, {0.5f, 0.2f, 0.5f});
    const auto layers = scene({middle(), far, label("text", {0, 2, 0}, "middle")});
    EXPECT_EQ(redPixels(*render(*layers)), 0);
    EXPECT_EQ(countOf(*layers, "map.occluders"), 1) << "the own feature takes no part";
    EXPECT_EQ(countOf(*layers, "map.occluders.second"), 0);
    const auto own = scene({middle(), label("text", {0, 2, 0}, "middle")});
    EXPECT_EQ(redPixels(*render(*own)), whole("text"));
}

TEST_F(MapLabels, shareAPlaceWithThoseOfOtherFeatures)
{
    // Both boxes stand before both labels, each before its own too.
    const auto far = box("far", {0, 1, 0}, {0.5f, 0.2f, 0.5f});
    const auto both = scene({middle(), far, label("A", {0, 2, 0.1}, "middle"),
                             label("B", {0, 2, -0.1}, "far"), label("C", {0, 2, 0})});
    EXPECT_EQ(redPixels(*render(*both)), 0);
    EXPECT_EQ(countOf(*both, "map.occluders.second"), 2);
    const auto inner = scene(
        {middle(), far, label("A", {0, 0.9, 0.1}, "middle"), label("B", {0, 0.9, -0.1}, "far")});
    EXPECT_EQ(redPixels(*render(*inner)), whole("A", {0, 0.9, 0.1})) << "B is behind the middle";
}

TEST_F(MapLabels, ofAFeatureWithPartsAreHiddenByNoneOfThem)
{
    osg::ref_ptr<osg::Group> house = new osg::Group;
    house->setName("house");
    house->addChild(before("wing"));
    house->addChild(middle("tower"));
    const int all = whole("house", {-0.3, 0.5, 0}), wing = whole("wing", {0.7, -1, 0.5});
    EXPECT_EQ(redPixels(*render(*scene({house, label("house", {-0.3, 0.5, 0}, "house")}))), all);
    // The wing has a label of its own and stays a part of the house.
    const auto nested = scene(
        {house, label("house", {-0.3, 0.5, 0}, "house"), label("wing", {0.7, -1, 0.5}, "wing")});
    EXPECT_EQ(redPixels(*render(*nested)), all + wing);
    const auto tower = scene(
        {house, label("tower", {-0.3, 0, 0}, "tower"), label("wing", {0.7, -1, 0.5}, "wing")});
    EXPECT_EQ(redPixels(*render(*tower)), wing) << "the wing hides the tower's";
}
