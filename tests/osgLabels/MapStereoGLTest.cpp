// SPDX-License-Identifier: MIT
// Labels in stereo: the viewer's own, with two pictures of one camera in each frame, and that of
// slave cameras.
#include "MapPictures.h"

#include <support/NotifyCapture.h>
#include <support/WindowViews.h>

#include <osg/DisplaySettings>

#include <string>
#include <vector>

using namespace mapScene;
using labelScene::box;
using labelScene::Height;
using labelScene::keep;
using labelScene::Width;
using osg::DisplaySettings;

namespace
{

class MapStereo : public testing::TestWithParam<std::string>
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(labelScene::viewer()); }
    void TearDown() override
    {
        if (labelScene::viewer().isValid())
        {
            labelScene::viewer().getViewer().getCamera()->setDisplaySettings(nullptr);
            labelScene::viewer().setSimulationTime(0.0);
        }
        EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines());
    }

    static osg::ref_ptr<osgLabels::LabelScene> houses()
    {
        return scene({box("middle", {0, 0, 0}, {0.5f, 0.3f, 0.5f}),
                      box("before", {-0.5f, -1.2f, 0}, {0.4f, 0.2f, 0.7f}, {0.3f, 0.5f, 0.4f, 1}),
                      label("half of it", {0, 0, 0}, "middle"), label("above", {0.2, 0, 0.8}),
                      label("aside", {0.6, 0.8, 0.75})},
                     "surface=on," + GetParam());
    }

    /// The fourth of four frames a second apart, so that what labels remember counts.
    static Picture drawFrames(const support::CameraSpec& camera, int width)
    {
        const auto top = labelScene::unlit(houses());
        Picture picture;
        for (double second = 1.0; second <= 4.0; second += 1.0)
        {
            labelScene::viewer().setSimulationTime(second);
            picture = labelScene::viewer().render(top, camera, width, Height);
        }
        return picture;
    }

    static Picture draw(DisplaySettings::StereoMode mode, int width = Width)
    {
        const osg::ref_ptr<DisplaySettings> settings = new DisplaySettings;
        settings->setStereo(true);
        settings->setStereoMode(mode);
        settings->setSplitStereoHorizontalSeparation(0);
        settings->setSplitStereoVerticalSeparation(0);
        settings->setScreenDistance(4.0f);
        settings->setEyeSeparation(0.6f);
        labelScene::viewer().getViewer().getCamera()->setDisplaySettings(settings);
        // OSG makes the stencil of eyes that share a window's pixels where the window's size is
        // new.
        labelScene::viewer().render(new osg::Group, labelScene::fromFront(), width - 2, Height);
        return drawFrames(labelScene::fromFront(), width);
    }

    support::NotifyCapture _notify;
};

/// Pixels where channels of a mask differ between a picture and what begins at (x, y) in another.
int differing(const osg::Image& all, int x, int y, const osg::Image& eye, const osg::Vec4& mask)
{
    int count = 0;
    for (int t = 0; t < eye.t(); ++t)
        for (int s = 0; s < eye.s(); ++s)
        {
            const osg::Vec4 off = componentMultiply(all.getColor(unsigned(x + s), unsigned(y + t)) -
                                                        eye.getColor(unsigned(s), unsigned(t)),
                                                    mask);
            count += off.length() > 2.0f / 255.0f;
        }
    return count;
}

} // namespace

TEST_P(MapStereo, anaglyphsShowTheLeftEyeInRedAndTheRightOneInCyan)
{
    const Picture left = draw(DisplaySettings::LEFT_EYE), right = draw(DisplaySettings::RIGHT_EYE);
    const Picture both = draw(DisplaySettings::ANAGLYPHIC);
    keep(both, "map-stereo-anaglyph");
    EXPECT_GT(redPixels(*left), 300);
    EXPECT_GT(differing(*left, 0, 0, *right, {1, 1, 1, 0}), 1000) << "or nothing is tested";
    EXPECT_EQ(differing(*both, 0, 0, *left, {1, 0, 0, 0}), 0);
    EXPECT_EQ(differing(*both, 0, 0, *right, {0, 1, 1, 0}), 0);
}

TEST_P(MapStereo, halvesOfAWindowShowAnEyeEach)
{
    const Picture left = draw(DisplaySettings::LEFT_EYE, Width / 2);
    const Picture right = draw(DisplaySettings::RIGHT_EYE, Width / 2);
    const Picture both = draw(DisplaySettings::HORIZONTAL_SPLIT);
    keep(both, "map-stereo-split");
    EXPECT_GT(redPixels(*left), 300);
    const osg::Vec4 all(1, 1, 1, 0);
    EXPECT_GT(differing(*left, 0, 0, *right, all), 500);
    EXPECT_EQ(differing(*both, 0, 0, *left, all), 0);
    EXPECT_EQ(differing(*both, Width / 2, 0, *right, all), 0);
}

TEST_P(MapStereo, rowsOfAWindowShowAnEyeEach)
{
    const Picture left = draw(DisplaySettings::LEFT_EYE), right = draw(DisplaySettings::RIGHT_EYE);
    const Picture both = draw(DisplaySettings::HORIZONTAL_INTERLACE);
    keep(both, "map-stereo-rows");
    int ofLeft = 0, ofRight = 0;
    for (int y = 0; y < Height; ++y)
    {
        osg::ref_ptr<osg::Image> row[3];
        const Picture pictures[3] = {both, left, right};
        for (int i = 0; i < 3; ++i)
        {
            row[i] = new osg::Image;
            row[i]->setImage(Width, 1, 1, GL_RGBA, GL_RGBA, GL_UNSIGNED_BYTE,
                             pictures[i]->data(0, unsigned(y)), osg::Image::NO_DELETE);
        }
        const osg::Vec4 all(1, 1, 1, 0);
        const bool isLeft = differing(*row[0], 0, 0, *row[1], all) == 0;
        const bool isRight = differing(*row[0], 0, 0, *row[2], all) == 0;
        EXPECT_TRUE(isLeft || isRight) << "row " << y;
        ofLeft += isLeft && !isRight;
        ofRight += isRight && !isLeft;
    }
    EXPECT_GT(ofLeft, Height / 8);
    EXPECT_GT(ofRight, Height / 8);
}

TEST_P(MapStereo, slaveCamerasShowAnEyeEach)
{
    const support::CameraSpec middle = labelScene::fromFront(0.5 * Width / Height);
    const osg::Matrixd eyes[2] = {osg::Matrixd::translate(0.3, 0, 0),
                                  osg::Matrixd::translate(-0.3, 0, 0)};
    const auto top = houses();
    const Picture both = support::drawSlaves(*labelScene::unlit(top), middle, Width, Height,
                                             {{}, eyes[0]}, {{}, eyes[1]});
    ASSERT_TRUE(both);
    keep(both, "map-stereo-slaves");
    Picture alone[2];
    for (int i = 0; i < 2; ++i)
    {
        support::CameraSpec eye = middle;
        eye.view.postMult(eyes[i]);
        alone[i] = drawFrames(eye, Width / 2);
        EXPECT_GT(redPixels(*alone[i]), 300);
        EXPECT_EQ(differing(*both, i * Width / 2, 0, *alone[i], {1, 1, 1, 0}), 0) << "eye " << i;
    }
    EXPECT_GT(differing(*alone[0], 0, 0, *alone[1], {1, 1, 1, 0}), 500) << "or nothing is tested";
}

namespace
{

/// The window's buffers that pictures of a camera have gone to.
class DrawBuffers : public osg::Camera::DrawCallback
{
public:
    void operator()(osg::RenderInfo&) const override
    {
        GLint buffer = 0;
        glGetIntegerv(GL_DRAW_BUFFER, &buffer);
        buffers.push_back(GLenum(buffer));
    }

    mutable std::vector<GLenum> buffers;
};

} // namespace

// No context here has a right buffer, so OSG's call for it fails and both eyes go to the left one:
// it ends with the right eye alone, and nobody else may have set a buffer.
TEST_P(MapStereo, ofQuadBuffersEachEyeIsDrawnWholeIntoTheOneThatIsSet)
{
    osg::Camera& camera = *labelScene::viewer().getViewer().getCamera();
    const osg::ref_ptr<DrawBuffers> drawn = new DrawBuffers;
    const Picture right = draw(DisplaySettings::RIGHT_EYE);
    labelScene::viewer().setFailOnGLErrors(false);
    camera.setPostDrawCallback(drawn);
    const Picture last = draw(DisplaySettings::QUAD_BUFFER);
    camera.setPostDrawCallback(nullptr);
    const std::vector<std::string> errors = labelScene::viewer().getGLErrors();
    labelScene::viewer().setFailOnGLErrors(true);
    keep(last, "map-stereo-quad");
    EXPECT_EQ(differing(*last, 0, 0, *right, {1, 1, 1, 0}), 0);
    ASSERT_GE(drawn->buffers.size(), 8u) << "two eyes in four frames";
    for (const GLenum buffer : drawn->buffers)
        EXPECT_EQ(buffer, GLenum(GL_BACK_LEFT));
    for (const std::string& error : errors)
        EXPECT_EQ(error, "GL error 0x502") << "of glDrawBuffer(GL_BACK_RIGHT) alone";
}

INSTANTIATE_TEST_SUITE_P(Settings, MapStereo,
                         testing::Values("maptest=pixel", "maptest=share", "maptest=anchor",
                                         "declutter=on"));
