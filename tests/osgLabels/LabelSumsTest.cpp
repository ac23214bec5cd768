// SPDX-License-Identifier: MIT
#include "TableMirror.h"

#include <osgLabels/GlyphSet.h>

#include <gtest/gtest.h>

#include <random>

using namespace osgLabels;

namespace
{

using Codes = LabelTable::Codes;

float advanceOf(std::uint32_t code)
{
    return 0.25f + 0.015625f * float(code); // sums of these are exact
}

Codes randomCodes(std::size_t length, std::uint32_t largest, std::mt19937& random)
{
    Codes codes(length);
    for (auto& code : codes)
        code = random() % (largest + 1);
    return codes;
}

template <typename F> void expectSums(const TableMirror& mirror, std::uint32_t id, F advance)
{
    const Codes codes = mirror.codesOf(id);
    const std::vector<float> sums = mirror.sumsOf(id);
    if (codes.size() < 32) // quickly scanned: they have none
        return;
    double sum = 0.0;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        sum += double(advance(codes[i]));
        if ((i + 1) % 16 == 0 || i + 1 == codes.size())
        {
            ASSERT_EQ(sums[i / 16], float(sum)) << "identifier " << id << ", letter " << i;
        }
    }
}

} // namespace

TEST(LabelSumsTest, eachLengthHasTheSumsOfItsAdvances)
{
    LabelTable table;
    table.setAdvances(advanceOf);
    TableMirror mirror(table);
    std::mt19937 random(1);
    std::vector<Codes> texts(1025);
    for (std::uint32_t length = 1; length <= 1024; ++length)
        table.setCodes(length, texts[length] = randomCodes(length, 62, random));
    mirror.take();
    for (std::uint32_t length = 1; length <= 1024; ++length)
    {
        ASSERT_EQ(mirror.codesOf(length), texts[length]);
        expectSums(mirror, length, advanceOf);
    }
}

TEST(LabelSumsTest, sumsStayRightWhenTextsChangeAndCodesGrow)
{
    LabelTable table;
    table.setAdvances(advanceOf);
    TableMirror mirror(table);
    std::mt19937 random(2);
    std::vector<Codes> texts(200);
    for (unsigned int turn = 0; turn < 4000; ++turn)
    {
        const std::uint32_t id = 1 + random() % 199;
        const std::uint32_t largest = turn < 1000 ? 1 : turn < 2000 ? 62 : 1000;
        const std::size_t length = random() % 8 ? random() % 100 : random() % 1025;
        ASSERT_TRUE(table.setCodes(id, texts[id] = randomCodes(length, largest, random)));
        if (turn % 100)
            continue;
        mirror.take();
        for (std::uint32_t i = 1; i < 200; ++i)
        {
            ASSERT_EQ(mirror.codesOf(i), texts[i]);
            expectSums(mirror, i, advanceOf);
        }
    }
}

TEST(LabelSumsTest, aChangedTextSendsOnlyItselfWithItsSums)
{
    LabelTable table;
    table.setAdvances(advanceOf);
    table.reserveCodes(62);
    TableMirror mirror(table);
    std::mt19937 random(3);
    for (std::uint32_t id = 1; id <= 1000; ++id)
        table.setCodes(id, randomCodes(40, 62, random));
    mirror.take();
    table.setCodes(500, randomCodes(40, 62, random));
    mirror.take();
    // 40 codes of 6 bits, 3 sums: 336 bits, 12 words where they do not begin with one; a row.
    EXPECT_LE(mirror.sent, 13u * 4u);
    expectSums(mirror, 500, advanceOf);
}

TEST(LabelSumsTest, monospacedTextsHaveNoSums)
{
    LabelTable plain, summed;
    summed.setAdvances(advanceOf);
    const Codes codes(160, 62);
    plain.setCodes(1, codes);
    summed.setCodes(1, codes);
    EXPECT_EQ(plain.getSizes().textBytes, 4u * ((162 * 6 + 31) / 32));
    EXPECT_GE(summed.getSizes().textBytes, plain.getSizes().textBytes + 10 * 4);
}

TEST(LabelSumsTest, shortTextsTakeNoMoreWithAdvances)
{
    for (const std::size_t length : {1u, 20u, 31u, 32u})
    {
        LabelTable plain, summed;
        summed.setAdvances(advanceOf);
        std::mt19937 random(4), again(4);
        for (std::uint32_t id = 1; id <= 1000; ++id)
        {
            plain.setCodes(id, randomCodes(length, 62, random));
            summed.setCodes(id, randomCodes(length, 62, again));
        }
        if (length < 32)
        {
            EXPECT_EQ(summed.getSizes().textBytes, plain.getSizes().textBytes) << length;
        }
        else
        {
            EXPECT_GE(summed.getSizes().textBytes, plain.getSizes().textBytes + 8000) << length;
        }
    }
}

TEST(LabelSumsTest, anEmptyTextHasNone)
{
    LabelTable table;
    table.setAdvances(advanceOf);
    TableMirror mirror(table);
    table.setCodes(1, Codes(40, 3));
    table.setCodes(1, Codes());
    mirror.take();
    EXPECT_TRUE(mirror.sumsOf(1).empty());
}

TEST(LabelSumsTest, ligaturesAndCombiningMarksAreSummedAsTheyAreDrawn)
{
    std::string error;
    const auto face = FontFace::open("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", error);
    if (!face)
        GTEST_SKIP() << "NOT TESTED: " << error;
    GlyphSet glyphs(face, Spacing::Proportional);
    const auto advance = [&](std::uint32_t code) { return glyphs.getGlyph(code)->advance; };
    LabelTable table;
    table.setAdvances(advance);
    TableMirror mirror(table);
    const std::string text =
        u8"office \u0301e\u0301a\u0323\u0302 \u00e9\ufb03 fluff waffle A\u030a";
    table.setCodes(1, glyphs.codesOf(text + text + text));
    mirror.take();
    expectSums(mirror, 1, advance);
    EXPECT_GT(mirror.sumsOf(1).back(), 10.0f);
}
