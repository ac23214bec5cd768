// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

#include <algorithm>

using osgShadowVolume::ShadowedScene;
using Lines = support::NotifyCapture::Lines;

/// A scene that is drawn, in a window without a user.
class ShadowKeysGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        OSGKITS_NEED_GL(_viewer);
        _scene->addChild(new osg::ShapeDrawable(new osg::Sphere));
    }

    /// Draws a frame that begins with a press of this key; returns what is printed.
    Lines press(int key)
    {
        support::NotifyCapture capture(osg::NOTICE);
        _viewer.getViewer().getEventQueue()->keyPress(key);
        _viewer.render(_scene, support::CameraSpec::overview(*_scene, 1.0), 64, 64);
        return capture.takeMessages();
    }

    support::HeadlessViewer _viewer{{64, 64}};
    osg::ref_ptr<ShadowedScene> _scene = new ShadowedScene;
};

TEST_F(ShadowKeysGLTest, thePlanOfTheLastFrameIsPrinted)
{
    press('y');
    const Lines lines = press('P');
    ASSERT_GT(lines.size(), 2u);
    EXPECT_EQ(lines[0].find("osgShadowVolume::ShadowedScene, camera"), 0u) << lines[0];
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                            [](const std::string& line) { return !line.find("  light 0"); }));
}

TEST_F(ShadowKeysGLTest, aWindowWithoutAUserBringsNoListOfKeys)
{
    EXPECT_EQ(press('y'), Lines{});
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=map"});
}
