// SPDX-License-Identifier: MIT
// Labels in the viewer's own stereo: two pictures of one camera in each frame.
#include "MapPictures.h"

#include <support/NotifyCapture.h>

#include <osg/DisplaySettings>

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

    /// The fourth of four frames of a second each, so that what labels remember counts.
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
        const auto top =
            scene({box("middle", {0, 0, 0}, {0.5f, 0.3f, 0.5f}),
                   box("before", {-0.5f, -1.2f, 0}, {0.4f, 0.2f, 0.7f}, {0.3f, 0.5f, 0.4f, 1}),
                   label("half of it", {0, 0, 0}, "middle"), label("above", {0.2, 0, 0.8}),
                   label("aside", {0.6, 0.8, 0.75})},
                  "surface=on," + GetParam());
        Picture picture;
        // OSG makes the stencil of eyes that share a window's pixels where the window's size is
        // new.
        labelScene::viewer().render(new osg::Group, labelScene::fromFront(), width - 2, Height);
        for (double second = 1.0; second <= 4.0; second += 1.0)
        {
            labelScene::viewer().setSimulationTime(second);
            picture = labelScene::viewer().render(top, labelScene::fromFront(), width, Height);
        }
        return picture;
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

INSTANTIATE_TEST_SUITE_P(Settings, MapStereo,
                         testing::Values("maptest=pixel", "maptest=share", "maptest=anchor",
                                         "declutter=on"));
