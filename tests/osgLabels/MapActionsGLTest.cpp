// SPDX-License-Identifier: MIT
// What becomes of the part of a map label that something stands before.
#include "MapPictures.h"

#include <support/NotifyCapture.h>

#include <osg/BlendFunc>
#include <osg/ValueObject>

using namespace mapScene;

namespace
{

class MapActions : public MapTest
{
};

const char* const Look = "surface=off,declutter=off,mapsize=24,ink=#000000,plate=#ffffff";

osg::ref_ptr<osgLabels::LabelScene> looking(const std::vector<osg::ref_ptr<osg::Node>>& nodes,
                                            const std::string& settings)
{
    const auto top = labelScene::labelled(nullptr, Look + std::string(",") + settings);
    for (const osg::ref_ptr<osg::Node>& node : nodes)
        top->addChild(node);
    return top;
}

/// Stands before the left half of the view.
osg::ref_ptr<osg::Geode> before(const std::string& name)
{
    return box(name, {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}, {0.4f, 0.5f, 0.9f, 1});
}

/// Pixels left of the middle whose colour is within 0.02 of this one.
int leftPixels(const osg::Image& picture, const osg::Vec3& color)
{
    int count = 0;
    for (int y = 0; y < picture.t(); ++y)
        for (int x = 0; x < picture.s() / 2; ++x)
        {
            const osg::Vec4 there = picture.getColor(unsigned(x), unsigned(y));
            count += (osg::Vec3(there.x(), there.y(), there.z()) - color).length() < 0.02f;
        }
    return count;
}

} // namespace

TEST_F(MapActions, fadeLeavesAQuarterOfTheOpacity)
{
    const auto top = looking({before("tree"), label("MAPLE", {})}, "mapaction=fade");
    const Picture picture = render(*top);
    ASSERT_TRUE(picture);
    keep(picture, "map-fade");
    const osg::Vec3 occluder(0.4f, 0.5f, 0.9f);
    EXPECT_GT(leftPixels(*picture, occluder * 0.75f + osg::Vec3(1, 1, 1) * 0.25f), 200);
    EXPECT_EQ(leftPixels(*picture, {1, 1, 1}), 0);
}

TEST_F(MapActions, recolorTakesTheColourForLetters)
{
    const auto top =
        looking({before("tree"), label("MAPLE", {})}, "mapaction=recolor,mapcolor=#00ff00");
    const Picture picture = render(*top);
    ASSERT_TRUE(picture);
    keep(picture, "map-recolor");
    EXPECT_GT(leftPixels(*picture, {0, 1, 0}), 50);
    EXPECT_GT(leftPixels(*picture, {1, 1, 1}), 200) << "the plate stays";
    EXPECT_EQ(leftPixels(*picture, {0, 0, 0}), 0);
}

TEST_F(MapActions, outlineLeavesTheEdgesOfLetters)
{
    const auto all = looking({before("tree"), label("MAPLE", {})}, "mapaction=ignore");
    const auto top = looking({before("tree"), label("MAPLE", {})}, "mapaction=outline");
    const Picture picture = render(*top), ignored = render(*all);
    ASSERT_TRUE(picture && ignored);
    keep(picture, "map-outline");
    EXPECT_EQ(leftPixels(*picture, {1, 1, 1}), 0) << "no plate";
    const osg::Vec3 occluder(0.4f, 0.5f, 0.9f);
    EXPECT_GT(leftPixels(*render(*looking({before("tree")}, "")), occluder),
              leftPixels(*picture, occluder) + 100);
    EXPECT_GT(leftPixels(*ignored, {1, 1, 1}), 200);
}

TEST_F(MapActions, goByTheClassOfWhatStandsThere)
{
    const std::string classes = "mapclass='tree:fade,^house:recolor,[0-9]{1,2}th:ignore'";
    const auto with = [&](const std::string& name) {
        return render(*looking({before(name), label("MAPLE", {})}, classes));
    };
    EXPECT_EQ(labelScene::changedShare(
                  *with("apple tree"),
                  *render(*looking({before(""), label("MAPLE", {})}, "mapaction=fade"))),
              0.0);
    EXPECT_EQ(labelScene::changedShare(
                  *with("house 7"),
                  *render(*looking({before(""), label("MAPLE", {})}, "mapaction=recolor"))),
              0.0);
    EXPECT_EQ(
        labelScene::changedShare(
            *with("12th"), *render(*looking({before(""), label("MAPLE", {})}, "mapaction=ignore"))),
        0.0);
    EXPECT_EQ(labelScene::changedShare(*with("lighthouse"),
                                       *render(*looking({before(""), label("MAPLE", {})}, ""))),
              0.0);
}

TEST_F(MapActions, goByTheUserValueLabelClass)
{
    const auto wall = before("wall");
    wall->setUserValue("labelClass", std::string("tree"));
    const Picture faded =
        render(*looking({wall, label("MAPLE", {})}, "mapclass='wall:ignore,tree:fade'"));
    const Picture expected = render(*looking({wall, label("MAPLE", {})}, "mapaction=fade"));
    EXPECT_EQ(labelScene::changedShare(*faded, *expected), 0.0);
}

TEST_F(MapActions, theStrongestOfSeveralCounts)
{
    const auto near = box("tree", {-0.5f, -1.5f, 0}, {0.4f, 0.1f, 0.5f});
    const auto hidden =
        looking({near, before("house"), label("MAPLE", {})}, "mapclass='tree:fade'");
    const auto alone = looking({near, before("house")}, "mapclass='tree:fade'");
    const Picture picture = render(*hidden);
    EXPECT_EQ(leftPixels(*picture, {1, 1, 1}), 0);
    EXPECT_EQ(countOf(*hidden, "map.actions"), 2);
    const Picture without = render(*alone);
    for (int x = 0; x < labelScene::Width / 2; ++x)
        for (int y = 0; y < labelScene::Height; ++y)
            ASSERT_EQ(picture->getColor(unsigned(x), unsigned(y)),
                      without->getColor(unsigned(x), unsigned(y)))
                << x << " " << y;
}

TEST_F(MapActions, transparentSurfacesCountFromHalfOfTheOpacityOn)
{
    for (const float alpha : {0.3f, 0.7f})
    {
        const auto glass =
            sheet("glass", {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, {0.5f, 0.9f, 0.9f, alpha});
        glass->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        glass->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        const int pixels = redPixels(*render(*scene({glass, label("text", {})})));
        EXPECT_EQ(pixels > 0, alpha < 0.5f) << alpha;
    }
}

TEST_F(MapActions, wrongClassesAreNamed)
{
    for (const char* const wrong : {"tree", "tree:vanish", "(:fade", ":hide"})
    {
        labelScene::labelled(nullptr, "mapclass='" + std::string(wrong) + "'");
        const support::NotifyCapture::Lines lines = _notify.takeWarnings();
        ASSERT_EQ(lines.size(), 1u) << wrong;
        EXPECT_NE(lines[0].find(wrong), std::string::npos) << lines[0];
    }
}
