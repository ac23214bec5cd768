// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphSet.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

using osgLabels::FontFace;
using osgLabels::GlyphSet;
using osgLabels::OutlineBounds;
using osgLabels::Spacing;
using osgLabels::TextShaper;

namespace
{

std::shared_ptr<FontFace> getDefaultFace()
{
    std::string error;
    const auto face = FontFace::openOrDefault("", error);
    EXPECT_TRUE(face) << error;
    EXPECT_EQ(error, "");
    return face;
}

} // namespace

TEST(GlyphSetTest, aMissingFontIsNamedAndTheDefaultTaken)
{
    std::string error;
    const auto face = FontFace::openOrDefault("no/such.ttf", error);
    ASSERT_TRUE(face);
    EXPECT_EQ(error, "font 'no/such.ttf': no such file, or it cannot be read");
    EXPECT_EQ(FontFace::open("no/such.ttf", error), nullptr);
}

TEST(GlyphSetTest, aFileThatIsNoFontIsNamedWithTheCause)
{
    const std::string file = testing::TempDir() + "osgLabelsNoFont.ttf";
    std::ofstream(file) << "no font at all";
    std::string error;
    EXPECT_EQ(FontFace::open(file, error), nullptr);
    EXPECT_EQ(error.find("font '" + file + "': not a font that FreeType opens: "), 0u) << error;
}

TEST(GlyphSetTest, theLineIsOneEmHigh)
{
    const auto face = getDefaultFace();
    const auto bar = osgLabels::getBounds(face->getOutline(face->getGlyph('|')));
    EXPECT_GT(bar.low.y, -0.01f);
    EXPECT_LT(bar.high.y, 1.01f);
    EXPECT_GT(bar.high.y - bar.low.y, 0.8f);
    // DejaVu Sans Mono: 1233 of 2384 font units.
    EXPECT_NEAR(face->getCellAdvance(), 1233.0 / 2384.0, 2e-3);
}

TEST(GlyphSetTest, codesAreNumberedInTheOrderOfTheirFirstUse)
{
    GlyphSet glyphs(getDefaultFace());
    EXPECT_EQ(glyphs.codesOf("abca"), (std::vector<std::uint32_t>{0, 1, 2, 0}));
    EXPECT_EQ(glyphs.codesOf("cd"), (std::vector<std::uint32_t>{2, 3}));
    EXPECT_EQ(glyphs.getSize(), 4u);
    EXPECT_TRUE(glyphs.codesOf("").empty());
}

TEST(GlyphSetTest, aLetterHasOneCodeWhetherItsTextIsAsciiOrNot)
{
    GlyphSet glyphs(getDefaultFace());
    const auto plain = glyphs.codesOf("ab");
    const auto mixed = glyphs.codesOf("ab\xC3\xA9");
    ASSERT_EQ(mixed.size(), 3u);
    EXPECT_EQ(mixed[0], plain[0]);
    EXPECT_EQ(mixed[1], plain[1]);
}

TEST(GlyphSetTest, aCombiningMarkIsOneGlyphWithItsLetter)
{
    GlyphSet glyphs(getDefaultFace());
    // q with a ring below, which no font has as one character.
    const auto codes = glyphs.codesOf("xq\xCC\xA5x");
    if (!TextShaper::isShaping())
    {
        EXPECT_EQ(codes.size(), 4u);
        return;
    }
    ASSERT_EQ(codes.size(), 3u);
    EXPECT_EQ(codes[0], codes[2]);
    const auto q = glyphs.codesOf("q");
    const auto marked = osgLabels::getBounds(glyphs.getGlyph(codes[1])->outline);
    const auto plain = osgLabels::getBounds(glyphs.getGlyph(q[0])->outline);
    EXPECT_LT(marked.low.y, plain.low.y - 0.02f) << "the ring is below the q";
    EXPECT_FLOAT_EQ(glyphs.getGlyph(codes[1])->advance, glyphs.getGlyph(q[0])->advance);
}

TEST(GlyphSetTest, aMissingGlyphIsNamedOnceAndShownAsTheFontsBox)
{
    std::vector<std::string> lines;
    const auto face = getDefaultFace();
    GlyphSet glyphs(face, Spacing::Cells, [&](const std::string& line) { lines.push_back(line); });
    const std::string text = "a\xF0\x93\x80\x80\xF0\x93\x80\x80"; // a hieroglyph, twice
    const auto codes = glyphs.codesOf(text);
    glyphs.codesOf(text);
    ASSERT_EQ(codes.size(), 3u);
    EXPECT_EQ(codes[1], codes[2]);
    EXPECT_FALSE(glyphs.getGlyph(codes[1])->outline.contours.empty());
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "osgLabels::GlyphSet: font '" + face->getFile() +
                            "' has no glyph for U+13000, its box is shown");
}

TEST(GlyphSetTest, controlCharactersAreSpaces)
{
    GlyphSet glyphs(getDefaultFace());
    const auto space = glyphs.codesOf(" ").at(0);
    const auto codes = glyphs.codesOf("\t\n\x7F");
    ASSERT_EQ(codes.size(), 3u);
    for (const std::uint32_t code : codes)
        EXPECT_EQ(glyphs.getGlyph(code)->outline.contours.size(),
                  glyphs.getGlyph(space)->outline.contours.size());
}

TEST(GlyphSetTest, inCellsNoGlyphIsWiderThanTheCell)
{
    std::string error;
    const auto face = FontFace::open("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", error);
    if (!face)
        GTEST_SKIP() << "NOT TESTED: " << error;
    GlyphSet cells(face), proportional(face, Spacing::Proportional);
    for (const std::uint32_t code : cells.codesOf("iW\xE2\x80\x94"))
        EXPECT_FLOAT_EQ(cells.getGlyph(code)->advance, cells.getCellAdvance());
    const auto codes = proportional.codesOf("iW");
    EXPECT_LT(proportional.getGlyph(codes[0])->advance,
              0.5f * proportional.getGlyph(codes[1])->advance);
}

TEST(GlyphSetTest, lettersOfADamagedFontAreNoLargerThanTheirImages)
{
    std::string error;
    const std::string intact = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    if (!FontFace::open(intact, error))
        GTEST_SKIP() << "NOT TESTED: " << error;
    std::ifstream file(intact, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), {});
    // 16 units an em instead of 2,048: all is 128 times larger.
    const std::size_t entry = bytes.find("head");
    ASSERT_NE(entry, std::string::npos);
    std::size_t head = 0;
    for (std::size_t i = 8; i < 12; ++i)
        head = head << 8 | static_cast<unsigned char>(bytes[entry + i]);
    bytes.replace(head + 18, 2, std::string("\0\x10", 2));
    const support::TemporaryFolder folder;
    const std::string damaged = folder.write("damaged.ttf", bytes);
    for (const Spacing spacing : {Spacing::Cells, Spacing::Proportional})
    {
        const auto face = FontFace::open(damaged, error);
        ASSERT_TRUE(face) << error;
        const auto glyphs = std::make_shared<GlyphSet>(face, spacing);
        for (const std::uint32_t code : glyphs->codesOf("AW"))
        {
            EXPECT_LE(glyphs->getGlyph(code)->advance, 16.0f);
            const OutlineBounds bounds = getBounds(glyphs->getGlyph(code)->outline);
            EXPECT_LE(bounds.high.x - bounds.low.x, 6.0f);
            EXPECT_LE(bounds.high.y - bounds.low.y, 3.0f);
        }
        EXPECT_LE(glyphs->getCellAdvance(), 4.0f);
    }
}

TEST(GlyphSetTest, threadsAgreeOnCodes)
{
    GlyphSet glyphs(getDefaultFace());
    std::vector<std::vector<std::uint32_t>> codes(4);
    std::vector<std::thread> threads;
    const std::string text = "P-1047/B \xC3\xA4\xC3\xB6\xC3\xBC q\xCC\xA5 \xCE\xA9";
    for (auto& own : codes)
        threads.emplace_back(
            [&]
            {
                for (int i = 0; i < 50; ++i)
                    own = glyphs.codesOf(text);
            });
    for (std::thread& thread : threads)
        thread.join();
    for (const auto& own : codes)
        EXPECT_EQ(own, codes[0]);
}

TEST(GlyphSetTest, textsOfKnownGlyphsHaveTheSameCodesEachTime)
{
    GlyphSet glyphs(getDefaultFace());
    std::vector<std::uint32_t> codes;
    const auto expected = glyphs.codesOf("10-PT-2041.A 37.5 bar");
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 20000; ++i)
    {
        codes.clear();
        glyphs.appendCodes("10-PT-2041.A 37.5 bar", codes);
        ASSERT_EQ(codes, expected);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    RecordProperty("textsASecond", static_cast<int>(20000 / elapsed.count()));
}
