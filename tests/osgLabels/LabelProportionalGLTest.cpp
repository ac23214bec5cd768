// SPDX-License-Identifier: MIT
// Letters of a proportional font on an object stand where their advances put them, however long
// the text is.
#include "LabelPictures.h"

#include <osgLabels/GlyphSet.h>

#include <cmath>
#include <vector>

using namespace labelScene;

namespace
{

constexpr char Font[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr int Wide = 1600, High = 64;

support::HeadlessViewer& wideViewer()
{
    static support::HeadlessViewer theViewer({Wide, High});
    theViewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return theViewer;
}

/// Bars, and between them letters of many widths that are lower than they are.
std::string barsAndLetters(std::size_t length)
{
    const std::string between = "m.mmw,r_nn...vmr";
    std::string text;
    while (text.size() + 1 < length)
        text += text.size() % 5 ? between[text.size() % between.size()] : '|';
    return text + '|';
}

/// How many em lie left of each bar.
std::vector<double> barsOf(const std::string& text)
{
    std::string error;
    osgLabels::GlyphSet glyphs(osgLabels::FontFace::open(Font, error),
                               osgLabels::Spacing::Proportional);
    const auto codes = glyphs.codesOf(text);
    std::vector<double> bars;
    double sum = 0.0;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        if (text[i] == '|')
            bars.push_back(sum);
        sum += double(glyphs.getGlyph(codes[i])->advance);
    }
    return bars;
}

/// The middles of dark runs in a row of a picture, by their darkness, in pixels.
std::vector<double> darkIn(const osg::Image& picture, int row)
{
    std::vector<double> middles;
    double sum = 0.0, moment = 0.0;
    for (int x = 0; x < picture.s(); ++x)
    {
        const double dark = 1.0 - double(picture.getColor(unsigned(x), unsigned(row)).g());
        if (dark > 0.05)
        {
            sum += dark;
            moment += dark * (x + 0.5);
        }
        else if (sum > 0.0)
        {
            middles.push_back(moment / sum);
            sum = moment = 0.0;
        }
    }
    return middles;
}

class LabelProportionalGLTest : public testing::TestWithParam<std::size_t>
{
protected:
    support::NotifyCapture _notify;
};

} // namespace

TEST_P(LabelProportionalGLTest, barsStandWhereTheAdvancesBeforeThemPutThem)
{
    OSGKITS_NEED_GL(wideViewer());
    std::string error;
    if (!osgLabels::FontFace::open(Font, error))
        GTEST_SKIP() << "NOT TESTED: " << error;
    const std::string text = barsAndLetters(GetParam());
    const std::vector<double> expected = barsOf(text);
    // A little longer than the text, so that it is there once.
    const auto length = float(1.1 * 0.024 * (expected.back() + 0.34));
    const auto strip = named(text, rectangle({-0.5f * length, 0.0f, -0.02f}, {length, 0.0f, 0.0f},
                                             {0.0f, 0.0f, 0.04f}, {1.0f, 1.0f, 1.0f, 1.0f}));
    const auto group = unlit(strip);
    group->addChild(named("", rectangle({-1.0f, 0.1f, -0.04f}, {2.0f, 0.0f, 0.0f},
                                        {0.0f, 0.0f, 0.08f}, {1.0f, 1.0f, 1.0f, 1.0f})));
    const auto scene = labelled(group, std::string("proportional=on,plate=off,ink=#000000,"
                                                   "readable=1,font=") +
                                           Font);
    const support::CameraSpec camera = {
        osg::Matrixd::lookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1)),
        osg::Matrixd::ortho(-1, 1, -0.04, 0.04, 1, 10)};
    const Picture picture = wideViewer().render(scene, camera, Wide, High, 2);
    keep(picture, "label-proportional-" + std::to_string(GetParam()));
    // The highest row with as many runs as there are bars: the letters between are lower.
    std::vector<double> found;
    for (int row = High - 1; row >= 0 && found.size() != expected.size(); --row)
        found = darkIn(*picture, row);
    ASSERT_EQ(found.size(), expected.size()) << text;
    const double pixels = (found.back() - found.front()) / (expected.back() - expected.front());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i] - found.front(), pixels * (expected[i] - expected.front()), 0.3)
            << "bar " << i << " of " << text;
}

// Scanned, the longest one that is, the first with sums, with many, and with a stored length.
INSTANTIATE_TEST_SUITE_P(Lengths, LabelProportionalGLTest, testing::Values(6, 31, 32, 62, 130));
