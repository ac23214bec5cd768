// SPDX-License-Identifier: MIT
// Labels of pipes that are far longer than what is seen of them.
#include "ExtremePictures.h"

#include <cmath>

using namespace labelScene;
using support::CameraSpec;

namespace
{

class LabelPipe : public PictureTest
{
};

/// Of a pipe of radius 1 along x, so that a whole text is in view.
CameraSpec besidePipe(double x)
{
    return lookFrom({x, -12, 0}, {x, 0, 0}, 12.0);
}

/// The columns, from the middle of the picture, to the middle of the ink of the nearest text that
/// is in view as a whole.
double columnsToText(const InkPictures& pictures)
{
    constexpr int gap = 20; // There are fewer between letters.
    double nearest = Width, ink = 0.0, sum = 0.0;
    int blank = 0;
    bool isWhole = false;
    for (int x = 0; x < Width; ++x)
    {
        double column = 0.0;
        // The text at the top of the pipe is farther away.
        for (int y = 0; y < Height / 2; ++y)
            column += pictures.without->getColor(unsigned(x), unsigned(y)).r() -
                      pictures.with->getColor(unsigned(x), unsigned(y)).r();
        blank = column > 0.1 ? 0 : blank + 1;
        if (blank == gap)
        {
            const double middle = sum / ink - 0.5 * (Width - 1); // NaN without ink
            if (isWhole && std::abs(middle) < std::abs(nearest))
                nearest = middle;
            isWhole = true;
            ink = sum = 0.0;
        }
        ink += column;
        sum += column * x;
    }
    EXPECT_LT(nearest, Width) << "no text is in view as a whole";
    return nearest;
}

/// Where near its middle the pipe has its letters as it has them at `x`, which floats can hold: in
/// between GL itself has no places for the eye.
double placeLike(osg::Group& model, double x)
{
    const double column = columnsToText(drawInk(&model, "pipe", besidePipe(x)));
    double like = 0.0;
    // Columns are not quite steps on a round surface: four times, for a hundredth of one.
    for (int i = 0; i < 4; ++i)
        like += (columnsToText(drawInk(&model, "pipe", besidePipe(like))) - column) * 2.0 * 11.0 *
                std::tan(osg::DegreesToRadians(20.0)) / Height;
    return like;
}

} // namespace

TEST_F(LabelPipe, oneGlyphOfALongPipeLiesWhereItDoesNearTheOrigin)
{
    // A glyph fills the picture. The same pipe, modelled so that what is seen lies at the origin,
    // is the truth; a millionth of the pipe would be several letters.
    const double length = 65536.0;
    const auto longPipe = labelled(unlit(pipe("P-101-A", -length / 2, length, 1.0f)), Plain);
    unsigned int marked = 0;
    for (double at : {0.0, 8192.0, 20480.0, 32000.0})
    {
        const auto nearPipe =
            labelled(unlit(pipe("P-101-A", -length / 2 - at, length, 1.0f)), Plain);
        for (double step : {0.0, 0.37, 0.81})
        {
            const auto camera = [&](double x) {
                return lookFrom({x + step, -2.2, 0}, {x + step, 0, 0}, 1.2);
            };
            const Picture actual = render(*longPipe, camera(at));
            const Picture expected = render(*nearPipe, camera(0.0));
            ASSERT_TRUE(actual && expected);
            keep(expected, "labelExtreme.pipe");
            marked += changedShare(*actual, *render(*longPipe->getChild(0), camera(at))) > 0.01;
            // A pixel along the outline of letters may differ.
            EXPECT_LE(support::difference(*actual, *expected, 0.25).getShareOver(), 0.005)
                << at << " + " << step;
        }
    }
    EXPECT_GT(marked, 6u) << "most of the places have a letter";
}

TEST_F(LabelPipe, aMillionRepetitionsAreEachInPlace)
{
    // Letters of height 1, 5.6 from text to text. The same pipe, modelled so that what is seen lies
    // at the origin, is the truth.
    const double length = 6e6;
    const osg::ref_ptr<osg::Group> longPipe = unlit(pipe("P-101-A", -length / 2, length, 1.0f));
    for (double x : {0.0, 1e6, -2.9e6})
    {
        const InkPictures actual = drawInk(longPipe, "million" + std::to_string(int(x)),
                                           lookFrom({x, -9, 0}, {x, 0, 0}, 9.0));
        EXPECT_GT(actual.inkShare(), 0.01) << x;
        const Picture expected = drawInk(unlit(pipe("P-101-A", -length / 2 - x, length, 1.0f)),
                                         "millionNear", lookFrom({0, -9, 0}, {0, 0, 0}, 9.0))
                                     .with;
        ASSERT_TRUE(actual.with && expected);
        EXPECT_LE(support::difference(*actual.with, *expected, 0.25).getShareOver(), 0.005) << x;
    }
}

TEST_F(LabelPipe, oneGlyphOfALongPipeLooksAsInItsMiddle)
{
    // A glyph fills the picture. A millionth of the pipe would be ten of its pixels.
    const osg::ref_ptr<osg::Group> model = unlit(pipe("P-101-A", -32768.0, 65536.0, 1.0f));
    int marked = 0;
    for (double at : {8192.0, -20480.0, 32000.0})
    {
        const double like = placeLike(*model, at);
        for (double step : {0.0, 0.375, 0.8125})
        {
            const auto draw = [&](double x) {
                return drawInk(model, "pipe", lookFrom({x, -2.2, 0}, {x, 0, 0}, 1.2));
            };
            const InkPictures actual = draw(at + step), expected = draw(like + step);
            ASSERT_TRUE(actual.with && expected.with);
            marked += actual.inkShare() > 0.01;
            EXPECT_LE(support::difference(*actual.with, *expected.with, 0.25).getShareOver(), 0.001)
                << at << " + " << step;
        }
    }
    EXPECT_GT(marked, 4) << "most of the places have a letter";
}

TEST_F(LabelPipe, eachOfAMillionRepetitionsLooksAsTheMiddleOne)
{
    const osg::ref_ptr<osg::Group> model = unlit(pipe("P-101-A", -3e6, 6e6, 1.0f));
    for (double at : {1e6, -2.9e6, 2.999e6})
    {
        const InkPictures actual = drawInk(model, "million", besidePipe(at));
        const InkPictures expected =
            drawInk(model, "millionLike", besidePipe(placeLike(*model, at)));
        ASSERT_TRUE(actual.with && expected.with);
        EXPECT_GT(actual.inkShare(), 0.02);
        // The distances that GL itself gives are rounded, so that outlines of letters differ.
        EXPECT_LE(support::difference(*actual.with, *expected.with, 0.25).getShareOver(), 0.01)
            << at;
    }
}
