// SPDX-License-Identifier: MIT
// Few slots, many pages, several views and contexts.
#include "VirtualScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>
#include <support/ResidentMemory.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace
{

using namespace osgPagedTexture;

/// As large as a slot is without compression.
constexpr double PageMiB = 64.0 * 64.0 * 4.0 / 1048576.0;

support::CameraSpec lookFrom(const osg::Vec3d& eye)
{
    return support::CameraSpec::perspective(eye, {eye.x(), 0.0, 0.0}, {0.0, 1.0, 0.0}, 50.0,
                                            4.0 / 3.0, 0.01, 1e4);
}

class VirtualBudgetGLTest : public testing::Test
{
protected:
    osg::ref_ptr<VirtualScene> makeScene(const std::string& settings, unsigned int seed = 1)
    {
        const std::string store = _folder.file("atlas" + std::to_string(seed));
        if (!std::filesystem::exists(store))
            virtuals::buildStore(store, virtuals::makeLevels(2048, 2048, seed));
        return virtuals::makeScene(virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f),
                                   settings, false);
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

std::string slots(int count)
{
    return "gpu=" + std::to_string((count + 0.01) * PageMiB);
}

} // namespace

TEST_F(VirtualBudgetGLTest, withFourPagesThePictureIsCoarseAndStable)
{
    OSGKITS_NEED_GL(_viewer);
    for (const int count : {1, 4, 9})
    {
        const auto scene = makeScene(slots(count));
        const auto camera = lookFrom({0.3, 0.0, 2.0});
        const auto first = virtuals::settle(_viewer, *scene, scene, camera);
        EXPECT_EQ(virtuals::countOf(*scene, "pages.slots"), double(count));
        const double uploaded = virtuals::countOf(*scene, "pages.uploaded");
        for (int frame = 0; frame < 30; ++frame)
        {
            const auto image = _viewer.render(scene, camera, 320, 240);
            ASSERT_EQ(support::difference(*image, *first, 0.0).worst, 0.0) << "frame " << frame;
        }
        EXPECT_EQ(virtuals::countOf(*scene, "pages.uploaded"), uploaded) << "thrashing";
        EXPECT_GT(virtuals::countOf(*scene, "levels.missing"), 0.0) << "no proof";
    }
}

TEST_F(VirtualBudgetGLTest, whereMorePagesAreNeededThanFitACoarserLevelIsChosenAndKept)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene(slots(49));
    // A slow turn: what is needed changes with each frame, and is always too much.
    for (int frame = 0; frame < 60; ++frame)
        _viewer.render(scene, lookFrom({0.002 * frame, 0.0, 1.8}), 320, 240);
    const auto camera = lookFrom({0.12, 0.0, 1.8});
    virtuals::settle(_viewer, *scene, scene, camera);
    const double uploaded = virtuals::countOf(*scene, "pages.uploaded");
    for (int frame = 0; frame < 40; ++frame)
        _viewer.render(scene, lookFrom({0.12 + 0.0001 * frame, 0.0, 1.8}), 320, 240);
    EXPECT_LE(virtuals::countOf(*scene, "pages.uploaded") - uploaded, 12.0) << "thrashing";
    EXPECT_GT(virtuals::countOf(*scene, "levels.missing"), 0.0) << "no proof";
    EXPECT_LE(virtuals::countOf(*scene, "pages.used"), 49.0);
}

TEST_F(VirtualBudgetGLTest, aFrozenSceneKeepsItsPages)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("");
    virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 12.0}));
    VirtualSettings settings = scene->getSettings();
    settings.freeze = true;
    scene->setSettings(settings);
    const double uploaded = virtuals::countOf(*scene, "pages.uploaded");
    for (int frame = 0; frame < 20; ++frame)
        _viewer.render(scene, lookFrom({0.0, 0.0, 1.0}), 320, 240);
    EXPECT_EQ(virtuals::countOf(*scene, "pages.uploaded"), uploaded);
    settings.freeze = false;
    scene->setSettings(settings);
    virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 1.0}));
    EXPECT_GT(virtuals::countOf(*scene, "pages.uploaded"), uploaded);
}

TEST_F(VirtualBudgetGLTest, twoContextsShowTheSameSceneEachFromItsPlace)
{
    OSGKITS_NEED_GL(_viewer);
    support::HeadlessViewer second;
    const auto alone = makeScene("");
    const auto both = makeScene("");
    const auto near = lookFrom({0.0, 0.0, 1.0}), far = lookFrom({2.0, 0.0, 6.0});
    const auto expectedNear = virtuals::settle(_viewer, *alone, alone, near);
    const auto expectedFar = virtuals::settle(_viewer, *alone, alone, far);
    osg::ref_ptr<osg::Image> actualNear, actualFar;
    for (int calm = 0, frame = 0; calm < 3 && frame < 2000; ++frame)
    {
        // Each viewer takes its context for the thread's current one.
        _viewer.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
        actualNear = _viewer.render(both, near, 320, 240);
        second.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
        actualFar = second.render(both, far, 320, 240);
        calm = both->isAtRest() ? calm + 1 : 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    // Pages lie in other slots, so that coordinates are rounded elsewhere.
    EXPECT_LE(support::difference(*actualNear, *expectedNear, 0.0).worst, 1.01 / 255.0);
    EXPECT_LE(support::difference(*actualFar, *expectedFar, 0.0).worst, 1.01 / 255.0);
    EXPECT_EQ(both->getPlans().size(), 2u);
    // The first viewer's objects go in its own context.
    second.getViewer().setSceneData(nullptr);
    _viewer.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
}

// A thousand jumps, and with OSGKITS_LONG ten thousand.
TEST_F(VirtualBudgetGLTest, randomJumpsLeaveNothingBehind)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene(slots(64) + ",cpu=2,upload=20");
    unsigned int seed = 7;
    const auto next = [&seed]
    { return double((seed = seed * 1664525u + 1013904223u) >> 8) / 16777216.0; };
    const int jumps = std::getenv("OSGKITS_LONG") ? 10000 : 1000;
    double warm = 0.0;
    for (int jump = 0; jump < jumps; ++jump)
    {
        _viewer.render(scene, lookFrom({8.0 * next() - 4.0, 0.0, 0.2 + 10.0 * next()}), 64, 48);
        if (jump == 500)
            warm = support::residentMiB();
    }
    // A page of a jump that stayed would be 16 KiB, 8 MiB of 500.
    EXPECT_LT(support::residentMiB(), warm + 4.0);
    EXPECT_LE(virtuals::countOf(*scene, "cpu.bytes"), 2.0 * 1048576.0);
    EXPECT_LE(virtuals::countOf(*scene, "pages.used"), 64.0);
    const auto actual = virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 20.0}));
    const auto fresh = makeScene("");
    const auto expected = virtuals::settle(_viewer, *fresh, fresh, lookFrom({0.0, 0.0, 20.0}));
    EXPECT_LE(support::difference(*actual, *expected, 0.0).worst, 1.01 / 255.0);
}
