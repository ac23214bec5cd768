// SPDX-License-Identifier: MIT
// Sizes, plates, leader lines, depths and tests of map labels; several views and samples.
#include "MapPictures.h"

#include <osg/MatrixTransform>
#include <osg/ValueObject>

using namespace mapScene;

namespace
{

class MapLook : public MapTest
{
};

struct Extent
{
    int left = 1 << 20, right = -1, bottom = 1 << 20, top = -1;
    int width() const { return right + 1 - left; }
    int height() const { return top + 1 - bottom; }
};

Extent redExtent(const osg::Image& picture)
{
    Extent extent;
    for (int y = 0; y < picture.t(); ++y)
        for (int x = 0; x < picture.s(); ++x)
        {
            const osg::Vec4 color = picture.getColor(unsigned(x), unsigned(y));
            if (!(color.r() > 0.6f && color.g() < 0.3f && color.b() < 0.3f))
                continue;
            extent.left = std::min(extent.left, x);
            extent.right = std::max(extent.right, x);
            extent.bottom = std::min(extent.bottom, y);
            extent.top = std::max(extent.top, y);
        }
    return extent;
}

osg::ref_ptr<osg::Geode> before()
{
    return box("before", {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}, {0.4f, 0.5f, 0.9f, 1});
}

} // namespace

TEST_F(MapLook, linesAreAsHighAsTheSettingSaysAtAnyDistance)
{
    for (const double y : {-1.0, 0.0, 5.0})
    {
        const Extent extent = redExtent(*render(*scene({label("Hg", {0, y, 0})}, "mapsize=20")));
        EXPECT_NEAR(extent.height(), 20 * 1.16, 1.5) << y; // the plate is 0.08 em higher
    }
}

TEST_F(MapLook, worldSizedLinesGetSmallerFartherAway)
{
    // A unit is 96 pixels at y = 0, 4 from the eye.
    const auto heightAt = [](double y) {
        return redExtent(*render(*scene({label("Hg", {0, y, 0})}, "mapworld=0.5"))).height();
    };
    EXPECT_NEAR(heightAt(0), 48 * 1.16, 1.5);
    EXPECT_NEAR(heightAt(4), 24 * 1.16, 1.5);
    const auto flat = scene({label("Hg", {0, 4, 0})}, "mapworld=0.5");
    EXPECT_NEAR(redExtent(*render(*flat, labelScene::parallel())).height(), 48 * 1.16, 1.5);
    const auto tiny = scene({label("Hg", {0, 0, 0})}, "mapworld=0.01");
    EXPECT_EQ(redPixels(*render(*tiny)), 0) << "too small to read";
    EXPECT_EQ(countOf(*tiny, "map.labels"), -1.0);
}

TEST_F(MapLook, leaderLinesRunFromTheAnchorUpToThePlate)
{
    const auto top = scene({label("text", {0, 0, -0.5})}, "mapleader=40");
    const Picture picture = render(*top);
    keep(picture, "map-leader");
    const osg::Vec2d anchor = pixelOf({0, 0, -0.5});
    const Extent extent = redExtent(*picture);
    EXPECT_NEAR(extent.bottom, anchor.y(), 1.5);
    EXPECT_NEAR(extent.top, anchor.y() + 40 + 14 * 1.16, 1.5);
    for (int y = 3; y < 38; y += 5)
        EXPECT_GT(picture->getColor(unsigned(anchor.x()), unsigned(anchor.y()) + unsigned(y)).r(),
                  0.5f)
            << y;
}

TEST_F(MapLook, platesAreOpaqueTranslucentOrNone)
{
    const auto pixels = [](const std::string& plate, const osg::Vec3& color)
    {
        const osg::Vec4 wall(0.5f, 0.5f, 0.5f, 1.0f);
        const Picture picture = render(*labelScene::unlit(scene(
            {sheet("wall", {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, wall), label("text", {0, 0, 0})},
            "mapsize=24,ink=#ff0000,plate=" + plate)));
        keep(picture, "map-plate");
        int count = 0;
        for (int y = 0; y < picture->t(); ++y)
            for (int x = 0; x < picture->s(); ++x)
            {
                const osg::Vec4 at = picture->getColor(unsigned(x), unsigned(y));
                count += (osg::Vec3(at.x(), at.y(), at.z()) - color).length() < 0.02f;
            }
        return count;
    };
    const osg::Vec3 opaque(0, 0, 1), half(0.25f, 0.25f, 0.75f);
    EXPECT_GT(pixels("#0000ff", opaque), 200);
    EXPECT_EQ(pixels("#0000ff", half), 0);
    EXPECT_GT(pixels("#0000ff80", half), 200);
    EXPECT_EQ(pixels("#0000ff80", opaque), 0);
    EXPECT_EQ(pixels("off", opaque) + pixels("off", half), 0);
    EXPECT_GT(pixels("off", {1, 0, 0}), 20) << "letters stay";
}

TEST_F(MapLook, theOffsetBringsLabelsNearer)
{
    const auto at = [](const std::string& settings) {
        return redPixels(*render(*scene({before(), label("text", {-0.5, 0, 0})}, settings)));
    };
    EXPECT_EQ(at(""), 0);
    EXPECT_EQ(at("mapoffset=0.5"), 0);
    EXPECT_GT(at("mapoffset=1"), 100);
    EXPECT_GT(at("mapoffset=1000"), 100) << "beyond the eye";
}

TEST_F(MapLook, backsOfOwnFeaturesSayTheDepthWhereThereAreSome)
{
    // The anchor is before what stands between it and the own back.
    const auto own = box("own", {0, 2, 0}, {2, 0.2f, 1});
    const auto at = [&](const std::string& depth)
    {
        return redPixels(*render(
            *scene({own, before(), label("text", {-0.5, -1.5, 0}, "own")}, "mapdepth=" + depth)));
    };
    EXPECT_GT(at("anchor"), 100);
    EXPECT_EQ(at("back"), 0);
    const auto beside = scene({own, before(), label("text", {-0.5, -1.5, 0})}, "mapdepth=back");
    EXPECT_GT(redPixels(*render(*beside)), 100) << "without a feature its anchor counts";
}

TEST_F(MapLook, anchorsDecideForTheWholeLabel)
{
    const auto at = [](double x)
    {
        return redPixels(
            *render(*scene({before(), label("longer text", {x, 0, 0})}, "maptest=anchor")));
    };
    EXPECT_EQ(at(-0.05), 0);
    EXPECT_EQ(at(0.05), redPixels(*render(*scene({label("longer text", {0.05, 0, 0})}))));
}

TEST_F(MapLook, sharesDecideForTheWholeLabel)
{
    const auto at = [](double x)
    {
        return redPixels(
            *render(*scene({before(), label("longer text", {x, 0, 0})}, "maptest=share")));
    };
    EXPECT_EQ(at(-0.2), 0);
    EXPECT_EQ(at(0.2), redPixels(*render(*scene({label("longer text", {0.2, 0, 0})}))));
}

TEST_F(MapLook, userValuesLabelTheTopsOfTheirNodes)
{
    const auto house = box("", {0.4f, 0, 0}, {0.3f, 0.3f, 0.3f});
    house->setUserValue("label", std::string("town hall"));
    const auto top = scene({house}, "map=values");
    const Picture picture = render(*top);
    keep(picture, "map-values");
    const Extent extent = redExtent(*picture);
    const osg::Vec2d at = pixelOf({0.4, 0, 0.3});
    EXPECT_NEAR(0.5 * (extent.left + extent.right + 1), at.x(), 1.0);
    EXPECT_NEAR(0.5 * (extent.bottom + extent.top + 1), at.y(), 1.0);
    EXPECT_EQ(redPixels(*render(*scene({house}))), 0) << "not asked for";
}

TEST_F(MapLook, samplesAndViewsOfTheirOwnShowTheSame)
{
    support::HeadlessSettings settings{labelScene::Width, labelScene::Height};
    settings.samples = 4;
    support::HeadlessViewer smooth(settings);
    OSGKITS_NEED_GL(smooth);
    smooth.getViewer().setLightingMode(osg::View::NO_LIGHT);
    const auto top = scene({before(), label("half of it", {0, 0, 0})});
    const Picture picture =
        smooth.render(top, labelScene::fromFront(), labelScene::Width, labelScene::Height, 2);
    ASSERT_TRUE(picture);
    keep(picture, "map-samples");
    EXPECT_EQ(redPixels(*picture), redPixels(*render(*top)));
    EXPECT_GT(redPixels(*picture), 100);
}
