// SPDX-License-Identifier: MIT
// Key points as they are seen, and the keys of the viewer.
#include "osgMultiRender/MixedPictures.h"

#include <osgMultiRender/MixKeys.h>
#include <support/TemporaryFolder.h>

#include <chrono>
#include <thread>

using namespace osgMultiRender;

namespace
{

class MixedKeysGLTest : public MixedPictures
{
protected:
    void SetUp() override
    {
        MixedPictures::SetUp();
        add("gooch", {0.0, 0.0, 2.0, 4.0});
        setKeys({{-1.6, -3.0, 0.5}, {1.5, -3.0, 1.0}});
    }

    int redPixels()
    {
        const osg::ref_ptr<osg::Image> picture = draw();
        int count = 0;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
            {
                const osg::Vec4 color = picture->getColor(unsigned(x), unsigned(y));
                count += color.r() > 0.3f && color.g() < 0.3f * color.r();
            }
        return count;
    }
};

} // namespace

TEST_F(MixedKeysGLTest, keyPointsAreRedSpheresAndWhatJoinsThem)
{
    const int none = redPixels();
    press('K');
    EXPECT_EQ(_scene->getMarks(), MixMarks::Points);
    const int points = redPixels();
    EXPECT_GT(points, none + 20);
    press('K');
    EXPECT_EQ(redPixels(), points) << "nothing joins single points";
    press('J');
    EXPECT_EQ(_scene->getKeyMode(), KeyMode::Polyline);
    EXPECT_GT(redPixels(), points + 40);
    support::writeImage(*draw(), "mixedMarks");
    press('K');
    EXPECT_EQ(redPixels(), none);
}

TEST_F(MixedKeysGLTest, filesThatWereEditedAreReadAgain)
{
    const support::TemporaryFolder folder;
    const std::string file =
        folder.write("own.frag", "void main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n");
    _scene->removeRendering(0);
    _scene->addRendering(importRendering(file));
    const int green = redPixels();
    folder.write("own.frag", "void main() { gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0); }\n");
    press('R');
    for (int i = 0; i < 20000 && redPixels() == green; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_GT(redPixels(), Size * Size / 8);
}

TEST_F(MixedKeysGLTest, keysChangeRangesAndPoints)
{
    draw();
    press(']');
    EXPECT_NEAR(_scene->getRange(0).dr3, 4.4, 1e-9);
    press('[');
    EXPECT_NEAR(_scene->getRange(0).dr3, 4.0, 1e-9);
    press('X', 0.99f, 0.99f);
    EXPECT_EQ(_scene->getKeyPoints().size(), 2u) << "nothing is there";
    _scene->setAnswersKeys(false);
    press('K');
    EXPECT_EQ(_scene->getMarks(), MixMarks::Off);
}

TEST_F(MixedKeysGLTest, pointsComeMoveAndGoOnTheSurfaceUnderTheMouse)
{
    draw();
    press('Y', 0.0f, -0.3f);
    std::vector<osg::Vec3d> points = _scene->getKeyPoints();
    ASSERT_EQ(points.size(), 3u);
    expectUnder(points[2], 0.0f, -0.3f);
    press('Y', 0.99f, 0.99f);
    EXPECT_EQ(_scene->getKeyPoints().size(), 3u) << "nothing is there";
    press('Q', 0.1f, -0.4f);
    points = _scene->getKeyPoints();
    ASSERT_EQ(points.size(), 3u);
    expectUnder(points[2], 0.1f, -0.4f);
    press('X', 0.1f, -0.4f);
    EXPECT_EQ(_scene->getKeyPoints(), std::vector<osg::Vec3d>(points.begin(), points.end() - 1));
}

TEST_F(MixedKeysGLTest, aKeyOverAnotherSceneIsThatOnes)
{
    draw();
    const osg::ref_ptr<MixedScene> empty = new MixedScene;
    empty->addRendering(importNamed("gooch"));
    const osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(empty);
    both->addChild(_scene);
    _viewer.renderFloat(both, _camera, Size, Size);
    aim(0.0f, -0.3f).keyPress('Y');
    _viewer.renderFloat(both, _camera, Size, Size);
    EXPECT_EQ(empty->getKeyPoints().size(), 0u);
    EXPECT_EQ(_scene->getKeyPoints().size(), 3u);
}

TEST_F(MixedKeysGLTest, keysThatAreOfNoPlaceReachAllScenesOnce)
{
    const osg::ref_ptr<MixedScene> other = new MixedScene;
    other->addRendering(importNamed("toon"), {0.0, 0.0, 1.0, 2.0});
    other->setMarks(MixMarks::Points); // not where the first one is
    const osg::ref_ptr<osg::Group> all = new osg::Group, again = new osg::Group;
    for (const auto& child : {_scene, other, _scene})
        all->addChild(child);
    again->addChild(_scene); // a second place
    all->addChild(again);
    const auto pressed = [&](int key)
    {
        aim(0.0, -0.3).keyPress(key);
        _viewer.getViewer().getEventQueue()->keyRelease(key);
        _viewer.renderFloat(all, _camera, Size, Size);
    };
    _viewer.renderFloat(all, _camera, Size, Size);
    pressed(']');
    EXPECT_NEAR(_scene->getRange(0).dr3, 4.4, 1e-9);
    EXPECT_NEAR(other->getRange(0).dr3, 2.2, 1e-9);
    pressed('K');
    EXPECT_EQ(_scene->getMarks(), MixMarks::Points);
    EXPECT_EQ(other->getMarks(), MixMarks::Points) << "as the first one has chosen";
    pressed('J');
    EXPECT_EQ(_scene->getKeyMode(), KeyMode::Polyline);
    EXPECT_EQ(other->getKeyMode(), KeyMode::Polyline);
}

TEST_F(MixedKeysGLTest, aMarkerFollowsTheMouseParallelToTheScreen)
{
    _scene->setMarks(MixMarks::Points);
    draw();
    const osg::Vec3d before = _scene->getKeyPoints()[1];
    const osg::Vec3d from = screenOf(before);
    const osg::Matrixd view = _viewer.getViewer().getCamera()->getViewMatrix();
    button(from.x(), from.y(), osgGA::GUIEventAdapter::MODKEY_LEFT_CTRL);
    aim(0.2f, 0.5f);
    draw();
    const osg::Vec3d after = _scene->getKeyPoints()[1];
    release(0.2f, 0.5f);
    expectUnder(after, 0.2f, 0.5f);
    // Single precision of the events' coordinates.
    EXPECT_NEAR((after * _camera.view).z(), (before * _camera.view).z(), 1e-4);
    EXPECT_EQ(_scene->getKeyPoints()[0], osg::Vec3d(-1.6, -3.0, 0.5));
    EXPECT_EQ(_viewer.getViewer().getCamera()->getViewMatrix(), view);
    aim(-0.5f, -0.5f);
    draw();
    EXPECT_EQ(_scene->getKeyPoints()[1], after) << "it was let go";
}

TEST_F(MixedKeysGLTest, clicksWithShiftMakePointsAndTakeMarkersAway)
{
    draw();
    button(0.0f, -0.3f, osgGA::GUIEventAdapter::MODKEY_LEFT_SHIFT);
    release(0.0f, -0.3f);
    ASSERT_EQ(_scene->getKeyPoints().size(), 3u);
    expectUnder(_scene->getKeyPoints()[2], 0.0f, -0.3f);
    _scene->setMarks(MixMarks::Points);
    button(0.0f, -0.3f, osgGA::GUIEventAdapter::MODKEY_LEFT_SHIFT);
    release(0.0f, -0.3f);
    EXPECT_EQ(_scene->getKeyPoints().size(), 2u);
    button(0.0f, -0.3f, 0);
    release(0.0f, -0.3f);
    EXPECT_EQ(_scene->getKeyPoints().size(), 2u) << "without a modifier it is the viewer's";
}
