// SPDX-License-Identifier: MIT
// What views remember of map labels: states of whole labels, and decluttering over time.
#include "MapPictures.h"

#include <support/NotifyCapture.h>

using namespace mapScene;
using labelScene::box;
using labelScene::countOf;
using labelScene::render;

namespace
{

class MapStates : public testing::Test
{
protected:
    void SetUp() override
    {
        OSGKITS_NEED_GL(labelScene::viewer());
        setTime(0.0);
    }
    void TearDown() override
    {
        if (labelScene::viewer().isValid())
            setTime(0.0);
    }

    static void setTime(double seconds) { labelScene::viewer().setSimulationTime(seconds); }

    support::NotifyCapture _notify;
};

osg::ref_ptr<osg::Geode> before()
{
    return box("before", {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}, {0.4f, 0.5f, 0.9f, 1});
}

/// Whether the label of the scene's second child, moved to x, is shown in one frame at a time.
bool isShown(osgLabels::LabelScene& scene, double x, double seconds)
{
    static_cast<osgLabels::MapLabels&>(*scene.getChild(1))
        .setLabels({{{x, 0, 0}, "longer text", 0, {}, {}}});
    labelScene::viewer().setSimulationTime(seconds);
    return redPixels(*render(scene, labelScene::fromFront(), labelScene::Width, labelScene::Height,
                             1)) > 0;
}

} // namespace

TEST_F(MapStates, aLabelKeepsItsStateForASecond)
{
    const auto top = scene({before(), label("longer text", {})}, "maptest=anchor");
    EXPECT_TRUE(isShown(*top, 0.2, 1.0));
    EXPECT_FALSE(isShown(*top, -0.2, 1.1)) << "it has been so for long";
    EXPECT_FALSE(isShown(*top, 0.2, 1.5)) << "it was hidden 0.4 s ago";
    EXPECT_FALSE(isShown(*top, 0.2, 2.05));
    EXPECT_TRUE(isShown(*top, 0.2, 2.15));
}

TEST_F(MapStates, sharesNearAHalfChangeNothing)
{
    const auto top = scene({before(), label("longer text", {})}, "maptest=share");
    // At x = 0.01 a little more than half is seen, at x = -0.01 a little less.
    EXPECT_TRUE(isShown(*top, 0.01, 10.0));
    EXPECT_TRUE(isShown(*top, -0.01, 20.0));
    EXPECT_FALSE(isShown(*top, -0.2, 30.0));
    EXPECT_FALSE(isShown(*top, 0.01, 40.0));
    EXPECT_TRUE(isShown(*top, 0.2, 50.0));
}

TEST_F(MapStates, aTimeThatStandsStillForgetsAll)
{
    const auto top = scene({before(), label("longer text", {})}, "maptest=share");
    EXPECT_TRUE(isShown(*top, 0.2, 5.0));
    EXPECT_FALSE(isShown(*top, -0.2, 5.0));
    EXPECT_TRUE(isShown(*top, 0.01, 5.0));
    EXPECT_FALSE(isShown(*top, -0.01, 5.0));
}

TEST_F(MapStates, nothingChangesAtRest)
{
    for (const char* const test : {"maptest=share", "maptest=anchor"})
    {
        const auto top = scene({before(), label("longer text", {0.0, 0, 0})}, test);
        const osg::ref_ptr<osg::Image> first = render(*top);
        for (int frame = 1; frame <= 300; ++frame)
        {
            setTime(frame / 60.0);
            ASSERT_TRUE(labelScene::areEqual(
                render(*top, labelScene::fromFront(), labelScene::Width, labelScene::Height, 1),
                first, "map-rest"))
                << test << ", frame " << frame;
        }
    }
}

TEST_F(MapStates, ofLabelsThatOverlapTheMoreImportantOneIsShown)
{
    osg::ref_ptr<osgLabels::MapLabels> labels = new osgLabels::MapLabels(
        {{{0, 0, 0}, "less important", 1, {}, {}}, {{0.05, 0.5, 0}, "more", 2, {}, {}}});
    const auto top = scene({labels}, "declutter=on");
    const auto alone = scene({label("more", {0.05, 0.5, 0})});
    EXPECT_EQ(redPixels(*render(*top)), redPixels(*render(*alone)));
    EXPECT_EQ(countOf(*top, "map.labels"), 1);
    EXPECT_EQ(countOf(*top, "map.labels.inView"), 2);
}
