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

    /// As if pressed at a place of the window, -1 to 1.
    void press(char key, float x = 0.0f, float y = 0.0f)
    {
        osgGA::EventQueue& queue = *_viewer.getViewer().getEventQueue();
        queue.setMouseInputRange(-1.0f, -1.0f, 1.0f, 1.0f);
        queue.getCurrentEventState()->setMouseYOrientation(
            osgGA::GUIEventAdapter::Y_INCREASING_UPWARDS);
        queue.mouseMotion(x, y);
        queue.keyPress(key);
        queue.keyRelease(key);
        draw();
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
    for (int i = 0; i < 500 && redPixels() == green; ++i)
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
