// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/LightSource>
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
        // A ball over a floor, under a lamp.
        _scene->addChild(new osg::ShapeDrawable(new osg::Sphere));
        _scene->addChild(new osg::ShapeDrawable(new osg::Box({0, 0, -1.5f}, 5, 5, 0.2f)));
        osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
        lamp->getLight()->setPosition({3, -1, 2.5f, 1});
        _scene->addChild(lamp);
    }

    /// Draws a frame that begins with a press of this key; returns what is printed.
    Lines press(int key)
    {
        support::NotifyCapture capture(osg::NOTICE);
        _viewer.getViewer().getEventQueue()->keyPress(key);
        _picture = _viewer.render(_scene, support::CameraSpec::overview(*_scene, 1.0), 64, 64);
        return capture.takeMessages();
    }

    support::HeadlessViewer _viewer{{64, 64}};
    osg::ref_ptr<ShadowedScene> _scene = new ShadowedScene;
    osg::ref_ptr<osg::Image> _picture; ///< Of the last frame.
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

TEST_F(ShadowKeysGLTest, theNextFrameShowsWhatAKeyChanged)
{
    press('y');
    const osg::ref_ptr<osg::Image> shadows = _picture;
    press('D'); // map
    press('D'); // off
    EXPECT_GT(support::difference(*_picture, *shadows, 16.0 / 255.0).getShareOver(), 0.01);
    press('D'); // volumes
    EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(_picture, shadows, "keys.shadows")));
    press('M');
    EXPECT_GT(support::difference(*_picture, *shadows, 16.0 / 255.0).getShareOver(), 0.03);
    press('M');
    EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(_picture, shadows, "keys.mask")));
}
