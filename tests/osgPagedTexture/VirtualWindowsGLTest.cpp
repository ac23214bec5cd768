// SPDX-License-Identifier: MIT
// Virtual textures in two windows of one viewer, each with a context of its own.
#include "VirtualScenes.h"

#include <support/CompareImage.h>
#include <support/WindowViews.h>

#include <osgViewer/CompositeViewer>

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace
{

using namespace osgPagedTexture;

constexpr int Width = 320, Height = 240;

support::CameraSpec lookFrom(const osg::Vec3d& eye)
{
    return support::CameraSpec::perspective(eye, {eye.x(), 0.0, 0.0}, {0.0, 1.0, 0.0}, 50.0,
                                            double(Width) / Height, 0.01, 1e4);
}

class VirtualWindowsGLTest : public testing::TestWithParam<osgViewer::ViewerBase::ThreadingModel>
{
protected:
    void SetUp() override
    {
        virtuals::buildStore(_folder.file("atlas"), virtuals::makeLevels(2048, 2048, 4));
    }

    osg::ref_ptr<osg::Geode> makeModel() const
    {
        return virtuals::makeFloor(virtuals::makeVirtualTexture(_folder.file("atlas")), 10.0f);
    }

    /// What each camera shows in a viewer of its own that waits for all pages.
    std::vector<osg::ref_ptr<osg::Image>>
    drawAlone(const std::vector<support::CameraSpec>& cameras) const
    {
        support::HeadlessViewer viewer;
        std::vector<osg::ref_ptr<osg::Image>> pictures;
        for (const support::CameraSpec& camera : cameras)
        {
            const auto scene = virtuals::makeScene(makeModel());
            pictures.push_back(virtuals::settle(viewer, *scene, scene, camera, Width, Height));
        }
        return pictures;
    }

    support::TemporaryFolder _folder;
};

} // namespace

TEST_P(VirtualWindowsGLTest, eachShowsItsPlaceAsAViewerOfItsOwnDoes)
{
    {
        support::HeadlessViewer probe;
        OSGKITS_NEED_GL(probe);
    }
    const std::vector<support::CameraSpec> cameras = {lookFrom({0.0, 0.0, 1.0}),
                                                      lookFrom({2.0, 0.0, 6.0})};
    const auto expected = drawAlone(cameras);
    const auto scene = virtuals::makeScene(makeModel(), "", false);
    osgViewer::CompositeViewer viewer;
    viewer.setThreadingModel(GetParam());
    std::vector<support::OwnWindow> windows;
    for (const support::CameraSpec& camera : cameras)
    {
        windows.emplace_back(*scene, camera, Width, Height);
        ASSERT_TRUE(windows.back().getView());
        viewer.addView(windows.back().getView());
    }
    viewer.realize();
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(4);
    // Pictures of a frame may come while the next one begins.
    for (int calm = 0; calm < 4; calm = scene->isAtRest() ? calm + 1 : 0)
    {
        viewer.frame();
        ASSERT_LT(std::chrono::steady_clock::now(), end) << "not at rest after four minutes";
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    viewer.stopThreading();
    EXPECT_EQ(scene->getPlans().size(), 2u);
    for (std::size_t i = 0; i < windows.size(); ++i)
    {
        const auto picture = windows[i].getPicture();
        ASSERT_TRUE(picture);
        // Pages lie in other slots, so that coordinates are rounded elsewhere.
        EXPECT_LE(support::difference(*picture, *expected[i], 0.0).worst, 1.01 / 255.0);
    }
}

INSTANTIATE_TEST_SUITE_P(ThreadingModels, VirtualWindowsGLTest,
                         testing::Values(osgViewer::ViewerBase::SingleThreaded,
                                         osgViewer::ViewerBase::CullDrawThreadPerContext,
                                         osgViewer::ViewerBase::DrawThreadPerContext));
