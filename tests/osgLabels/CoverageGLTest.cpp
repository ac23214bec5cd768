// SPDX-License-Identifier: MIT
#include "CoveragePage.h"

#include <osgLabels/GlyphCoverage.h>
#include <osgLabels/Shaders.h>
#include <support/HeadlessViewer.h>

#include <osg/StateSet>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using osgLabels::FontFace;
using osgLabels::GlyphAtlas;
using osgLabels::GlyphCoverage;
using osgLabels::GlyphSet;
using osgLabels::Spacing;

namespace
{

constexpr int Size = 128;

std::shared_ptr<GlyphSet> makeGlyphs(const std::string& font = {}, Spacing spacing = Spacing::Cells)
{
    std::string error;
    const auto face = FontFace::openOrDefault(font, error);
    EXPECT_TRUE(face && error.empty()) << error;
    return std::make_shared<GlyphSet>(face, spacing);
}

CoverageView makeView(double degrees, double squash, double pixelsPerEm)
{
    CoverageView view;
    view.degrees = degrees;
    view.squash = squash;
    view.pixelsPerEm = pixelsPerEm;
    return view;
}

/// What the default font's page needs.
struct Page
{
    std::shared_ptr<GlyphSet> glyphs = makeGlyphs();
    CoveragePage page{glyphs};
    osg::ref_ptr<GlyphAtlas> atlas = new GlyphAtlas(glyphs);
    Page() { atlas->update(); }
};

double getError(support::HeadlessViewer& viewer, const Page& page, const CoverageView& view)
{
    const auto picture = viewer.renderFloat(page.page.makeNode(view, *page.atlas), {}, Size, Size);
    return getRmsPercent(*picture, *page.page.makeTruth(view, Size));
}

float getPixel(const osg::Image& image, int x, int y)
{
    return *reinterpret_cast<const float*>(image.data(x, y));
}

/// Largest difference between the shader and its twin.
double getTwinDifference(support::HeadlessViewer& viewer, const CoveragePage& page,
                         const GlyphAtlas& atlas, const GlyphCoverage& twin,
                         const CoverageView& view)
{
    const auto picture = viewer.renderFloat(page.makeNode(view, atlas), {}, 64, 64);
    double most = 0.0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
        {
            int line = 0;
            const glm::vec2 place = page.getPlace(view, glm::dvec2(x + 0.5, y + 0.5), line);
            const float ink = twin.getInk(page.getLine(line), place, view.getFootprint());
            most = std::max(most, static_cast<double>(std::abs(ink - getPixel(*picture, x, y))));
        }
    return most;
}

} // namespace

TEST(CoverageGLTest, lettersSeenFrontallyOrRotatedAreTrueToOnePercentFromEightPixels)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    for (const double degrees : {0.0, 27.0})
        for (const double em : {8.0, 9.5, 12.0, 16.0, 19.0, 21.0, 32.0, 43.0, 48.0, 128.0})
            EXPECT_LE(getError(viewer, page, makeView(degrees, 1.0, em)), 1.0)
                << degrees << " degrees, " << em << " pixels an em";
}

TEST(CoverageGLTest, lettersFromFourPixelsAreTrueToTwoPercent)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    for (const double degrees : {0.0, 27.0, 45.0})
        for (const double em : {2.5, 4.0, 5.7, 6.7})
            EXPECT_LE(getError(viewer, page, makeView(degrees, 1.0, em)), 2.0)
                << degrees << " degrees, " << em << " pixels an em";
}

TEST(CoverageGLTest, longFootprintsAreSampledAlongTheirAxis)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    // Slices don't look at neighbouring letters, which costs 0.1 at 8 pixels an em, where 1.15 was
    // measured at 5.76, and 1.3 at 12; without slices 8 and more.
    for (const double squash : {4.0, 5.76, 12.0})
        for (const double degrees : {0.0, 27.0})
            for (const double em : {8.0, 12.0, 16.0, 24.0, 32.0, 64.0})
                for (const double axis : {0.0, 30.0})
                {
                    CoverageView view = makeView(degrees, squash, em);
                    view.axis = axis;
                    EXPECT_LE(getError(viewer, page, view), squash > 6.0 ? 1.4
                                                            : em < 12.0  ? 1.2
                                                                         : 1.0)
                        << degrees << " degrees, squashed by " << squash << " at " << axis << ", "
                        << em << " pixels an em";
                }
}

TEST(CoverageGLTest, footprintsALittleLongerThanWideAreTrueToTwoPercent)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    // One to four squares stand for a skewed pixel.
    for (const double squash : {1.15, 1.5, 1.8, 2.2, 3.0})
        for (const double em : {8.0, 16.0})
            EXPECT_LE(getError(viewer, page, makeView(27.0, squash, em)), 2.0)
                << "squashed by " << squash << ", " << em << " pixels an em";
}

TEST(CoverageGLTest, theShaderAndItsTwinAgree)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    const GlyphCoverage twin(page.glyphs);
    // Software filtering has 8 bits for the place within a texel; a gain of up to 1/32 em times
    // 48 pixels an em follows.
    for (const CoverageView& view :
         {makeView(0.0, 1.0, 1.5), makeView(0.0, 1.0, 4.0), makeView(27.0, 1.0, 11.0),
          makeView(27.0, 1.0, 30.0), makeView(10.0, 1.0, 60.0), makeView(27.0, 4.0, 16.0),
          makeView(0.0, 30.0, 40.0)})
        EXPECT_LE(getTwinDifference(viewer, page.page, *page.atlas, twin, view), 0.03)
            << view.pixelsPerEm << " pixels an em, squashed by " << view.squash;
}

TEST(CoverageGLTest, proportionalLettersStandWhereTheirAdvancesPutThem)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    std::string error;
    const std::string font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    if (!FontFace::open(font, error))
        GTEST_SKIP() << "NOT TESTED: " << error;
    const auto glyphs = makeGlyphs(font, Spacing::Proportional);
    const CoveragePage page(glyphs);
    const osg::ref_ptr<GlyphAtlas> atlas = new GlyphAtlas(glyphs);
    atlas->update();
    for (const double em : {12.0, 30.0, 60.0})
    {
        const CoverageView view = makeView(27.0, 1.0, em);
        const auto picture = viewer.renderFloat(page.makeNode(view, *atlas), {}, 64, 64);
        EXPECT_LE(getRmsPercent(*picture, *page.makeTruth(view, 64)), 1.2) << em;
    }
}

TEST(CoverageGLTest, lettersFoundBySumsAreThoseFoundFromTheStart)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    std::string error;
    const std::string font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    if (!FontFace::open(font, error))
        GTEST_SKIP() << "NOT TESTED: " << error;
    const auto glyphs = makeGlyphs(font, Spacing::Proportional);
    const CoveragePage page(glyphs);
    const osg::ref_ptr<GlyphAtlas> atlas = new GlyphAtlas(glyphs);
    atlas->update();
    const std::string sums = "#define OSGLABELS_SUMS 32\n"
                             "float osgLabels_advanceAt(osgLabels_Text text, int index);\n"
                             "float osgLabels_sumOf(osgLabels_Text text, int count)\n"
                             "{\n"
                             "    float sum = 0.0;\n"
                             "    for (int i = 0; i < min(16 * count, text.length); ++i)\n"
                             "        sum += osgLabels_advanceAt(text, i);\n"
                             "    return sum;\n"
                             "}\n";
    const std::string shade = "float shade(osgLabels_Text text, vec2 place, mat2 footprint)\n"
                              "{ return osgLabels_coverage(text, place, footprint) +\n"
                              "         osgLabels_width(text); }\n";
    for (const double em : {0.11, 12.0, 60.0}) // 64 pixels at 0.11: all of the 1,024 letters
    {
        const auto draw = [&](const std::string& begin)
        {
            const auto node = page.makeNode(
                makeView(27.0, 1.0, em),
                begin + atlas->getDefines() + osgLabels::shaders::coverage_glsl + shade, 1);
            atlas->apply(*node->getOrCreateStateSet(), 0);
            return viewer.renderFloat(node, {}, 64, 64);
        };
        const auto scanned = draw(""), found = draw(sums);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) // rounding: the sums are of several hundred em
                ASSERT_NEAR(getPixel(*found, x, y), getPixel(*scanned, x, y), 1e-3) << em;
    }
}

TEST(CoverageGLTest, anEighthOfAPixelChangesCoverageAsItShould)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    page.atlas->setLegibleSize(0.0f);
    constexpr int Small = 64;
    for (const double degrees : {0.0, 27.0})
        for (const double squash : {1.0, 4.0})
            for (const double em : {2.0, 4.0, 8.0, 13.0, 23.98, 32.0, 46.0, 90.0, 200.0})
            {
                // By an eighth both ways; and closer by an eighth of a pixel at the page's edge.
                CoverageView before = makeView(degrees, squash, em), after = before;
                after.shift = {0.125, 0.125};
                after.pixelsPerEm *= 1.0 + 0.125 / Small;
                const auto a = viewer.renderFloat(page.page.makeNode(before, *page.atlas), {},
                                                  Small, Small),
                           b = viewer.renderFloat(page.page.makeNode(after, *page.atlas), {}, Small,
                                                  Small);
                const double own = getRmsPercent(*page.page.makeTruth(before, Small),
                                                 *page.page.makeTruth(after, Small));
                // 1.7 at 2 pixels an em squashed 4:1, half a pixel along; else 0.7 at most.
                EXPECT_LE(getRmsPercent(*a, *b), own + (em < 4.0 ? 2.0 : 1.0))
                    << em << " pixels an em, squashed by " << squash << ", " << degrees
                    << " degrees";
            }
}

TEST(CoverageGLTest, noSeamIsSeenWhereMethodsChange)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    const auto render = [&](double em, double squash)
    {
        return viewer.renderFloat(page.page.makeNode(makeView(27.0, squash, em), *page.atlas), {},
                                  Size, Size);
    };
    // Squares to distances, four look-ups coming together, one look-up to four, four to slices.
    const double quartered = 1.1522, sliced = 1.6546;
    for (const auto& [em, squash] :
         {std::make_pair(24.0, 1.0), std::make_pair(40.0, 1.0), std::make_pair(48.0, 1.0),
          std::make_pair(24.0, 4.0), std::make_pair(64.0, quartered), std::make_pair(64.0, sliced)})
    {
        // The text itself moves by this zoom: 0.02 to 0.1 pixels.
        constexpr double Zoom = 0.0001;
        const auto at = [&](double steps)
        { return render(em * (1.0 + steps * Zoom), squash * (1.0 + steps * Zoom)); };
        const auto farther = at(-3.0), below = at(-1.0), above = at(1.0);
        const double step = getRmsPercent(*below, *above), usual = getRmsPercent(*farther, *below);
        // 0.66 was measured at 24 pixels an em, less than two of 255.
        EXPECT_LE(std::sqrt(std::max(0.0, step * step - usual * usual)), 0.72)
            << em << " pixels an em, squashed by " << squash;
        double tone = 0.0;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
                tone += getPixel(*below, x, y) - getPixel(*above, x, y);
        EXPECT_LE(std::abs(tone) / (Size * Size), 0.5 / 255.0)
            << em << " pixels an em, squashed by " << squash;
    }
}

TEST(CoverageGLTest, lettersTooSmallToReadFadeToTheirTone)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    const auto tone =
        viewer.renderFloat(page.page.makeNode(makeView(0.0, 1.0, 0.7), *page.atlas), {}, 16, 16);
    const float mean = getPixel(*tone, 3, 3);
    EXPECT_GT(mean, 0.05f);
    EXPECT_LT(mean, 0.4f);
    EXPECT_EQ(getPixel(*tone, 9, 12), mean);
    page.atlas->setToneBelowLegible(false);
    const auto nothing =
        viewer.renderFloat(page.page.makeNode(makeView(0.0, 1.0, 0.7), *page.atlas), {}, 16, 16);
    EXPECT_EQ(getPixel(*nothing, 3, 3), 0.0f);
}

TEST(CoverageGLTest, anOutlineGrowsTheInk)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const Page page;
    const osg::ref_ptr<GlyphAtlas> atlas = new GlyphAtlas(page.glyphs, 0.05f);
    atlas->update();
    const std::string source = atlas->getDefines() + osgLabels::shaders::coverage_glsl +
                               "float shade(osgLabels_Text text, vec2 place, mat2 footprint)\n"
                               "{ return osgLabels_inkAndOutline(text, place, footprint).y; }\n";
    for (const double em : {10.0, 40.0})
    {
        const CoverageView view = makeView(0.0, 1.0, em);
        const auto node = page.page.makeNode(view, source);
        atlas->apply(*node->getOrCreateStateSet(), 0);
        const auto ink = viewer.renderFloat(page.page.makeNode(view, *page.atlas), {}, Size, Size),
                   grown = viewer.renderFloat(node, {}, Size, Size);
        double inkSum = 0.0, grownSum = 0.0;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
            {
                // 8 bits an image, and two look-ups: a step or two less is no loss of ink.
                EXPECT_GE(getPixel(*grown, x, y), getPixel(*ink, x, y) - 0.05f);
                inkSum += getPixel(*ink, x, y);
                grownSum += getPixel(*grown, x, y);
            }
        EXPECT_GT(grownSum, 1.5 * inkSum) << em;
    }
}

TEST(CoverageGLTest, glyphsThatComeLaterAreShown)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const auto glyphs = makeGlyphs();
    const osg::ref_ptr<GlyphAtlas> atlas = new GlyphAtlas(glyphs);
    glyphs->codesOf("a");
    EXPECT_TRUE(atlas->update());
    EXPECT_FALSE(atlas->update());
    const CoverageView view = makeView(0.0, 1.0, 16.0);
    const CoveragePage first(glyphs, "a");
    const auto show = [&](const CoveragePage& page)
    {
        const auto picture = viewer.renderFloat(page.makeNode(view, *atlas), {}, Size, Size);
        return getRmsPercent(*picture, *page.makeTruth(view, Size));
    };
    EXPECT_LE(show(first), 1.0);
    // More than the 64 layers that the texture had at first.
    std::string many;
    for (char c = '!'; c <= '~'; ++c)
        many += c;
    const CoveragePage second(glyphs, many);
    EXPECT_TRUE(atlas->update());
    EXPECT_EQ(atlas->getNumGlyphs(), glyphs->getSize());
    EXPECT_LE(show(second), 1.0);
    EXPECT_LE(show(first), 1.0);
}
