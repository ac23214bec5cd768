// SPDX-License-Identifier: MIT
// What views remember of map labels: states of whole labels, and decluttering over time.
#include "MapPictures.h"

using namespace mapScene;

namespace
{

class MapStates : public MapTest
{
protected:
    static void setTime(double seconds) { labelScene::viewer().setSimulationTime(seconds); }
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

TEST_F(MapStates, eachPictureOfASceneInTwoPlacesKeepsItsOwn)
{
    const auto top = scene({before(), label("longer text", {})}, "maptest=anchor");
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(top);
    root->addChild(top);
    const auto isSeen = [&](double x, double seconds)
    {
        static_cast<osgLabels::MapLabels&>(*top->getChild(1))
            .setLabels({{{x, 0, 0}, "longer text", 0, {}, {}}});
        setTime(seconds);
        return redPixels(*render(*root, labelScene::fromFront(), labelScene::Width,
                                 labelScene::Height, 1)) > 0;
    };
    EXPECT_TRUE(isSeen(0.2, 1.0));
    EXPECT_FALSE(isSeen(-0.2, 1.1));
    EXPECT_FALSE(isSeen(0.2, 1.5)) << "it was hidden 0.4 s ago";
    EXPECT_TRUE(isSeen(0.2, 2.15));
}

TEST_F(MapStates, sharesNearAHalfChangeNothing)
{
    const auto top = scene({before(), label("longer text", {})}, "maptest=share");
    // About half of it is seen at x = 0.01 and -0.01.
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
    EXPECT_TRUE(isShown(*top, 0.08, 5.0));
    EXPECT_FALSE(isShown(*top, -0.08, 5.0));
}

TEST_F(MapStates, nothingChangesAtRest)
{
    for (const char* const test : {"maptest=share", "maptest=anchor"})
    {
        const auto top = scene({before(), label("longer text", {0.0, 0, 0})}, test);
        const osg::ref_ptr<osg::Image> first = render(*top);
        for (int frame = 1; frame <= 100; ++frame)
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

namespace
{

/// Two labels over each other, of which the more important one stands behind a wall; the wall is
/// a child of its own.
osg::ref_ptr<osgLabels::LabelScene> hiddenPair(const std::string& settings)
{
    osg::ref_ptr<osgLabels::MapLabels> labels = new osgLabels::MapLabels(
        {{{0, -3, 0}, "near", 1, {}, {}}, {{0.05, 0.5, 0}, "far away", 2, {}, {}}});
    return scene({box("wall", {0, -1, 0}, {0.9f, 0.1f, 0.7f}, {0.4f, 0.5f, 0.9f, 1}), labels},
                 "declutter=on" + settings);
}

/// Frames 0.1 s apart while the camera creeps, or rests.
Picture drawMany(osgLabels::LabelScene& scene, int from, int frames, double creep)
{
    Picture picture;
    for (int i = from; i < from + frames; ++i)
    {
        labelScene::viewer().setSimulationTime(1.0 + 0.1 * i);
        support::CameraSpec camera = labelScene::fromFront();
        camera.view.preMultTranslate(osg::Vec3d(creep * i, 0, 0));
        picture = render(scene, camera, labelScene::Width, labelScene::Height, 1);
    }
    return picture;
}

} // namespace

TEST_F(MapStates, aLabelThatIsHiddenKeepsNoPlace)
{
    for (const char* const test : {"", ",maptest=share", ",maptest=anchor"})
    {
        const auto top = hiddenPair(test);
        const auto wall = top->getChild(0);
        EXPECT_GT(redPixels(*render(*top)), 100) << "a picture that stands for itself" << test;
        wall->setNodeMask(0);
        drawMany(*top, 0, 1, 1e-4);
        EXPECT_EQ(countOf(*top, "map.labels"), 1);
        const int far = redPixels(*drawMany(*top, 1, 20, 1e-4));
        wall->setNodeMask(~0u);
        const int near = redPixels(*drawMany(*top, 21, 30, 1e-4));
        EXPECT_GT(far, near + 50) << "the longer text" << test;
        EXPECT_GT(near, 100) << "the other one takes its place" << test;
        const Picture last = drawMany(*top, 50, 1, 1e-4);
        for (int i = 0; i < (*test ? 20 : 300); ++i)
        {
            setTime(6.1 + i / 60.0);
            support::CameraSpec camera = labelScene::fromFront();
            camera.view.preMultTranslate(osg::Vec3d(1e-4 * 50, 0, 0));
            ASSERT_TRUE(labelScene::areEqual(
                render(*top, camera, labelScene::Width, labelScene::Height, 1), last, "map-place"))
                << "frame " << i << test;
        }
        wall->setNodeMask(0);
        EXPECT_EQ(redPixels(*drawMany(*top, 120, 30, 1e-4)), far) << "it comes back" << test;
    }
}

TEST_F(MapStates, aHiddenLabelDoesNotMakeOthersFlicker)
{
    const auto top = hiddenPair(",maptest=share");
    drawMany(*top, 0, 30, 1e-4);
    int changes = 0;
    int before = redPixels(*drawMany(*top, 30, 1, 1e-4));
    for (int i = 31; i < 130; ++i)
    {
        const int now = redPixels(*drawMany(*top, i, 1, 1e-4));
        // A crawl of 1e-4 a frame moves 0.01 pixels: the plate's edge by a column at most.
        changes += std::abs(now - before) > 30;
        before = now;
    }
    EXPECT_EQ(changes, 0);
}
