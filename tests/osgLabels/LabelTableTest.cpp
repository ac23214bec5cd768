// SPDX-License-Identifier: MIT
// What a table holds, and how small.
#include "LabelCodes.h"
#include "TableMirror.h"

#include <gtest/gtest.h>

#include <map>

using osgLabels::LabelTable;
using Codes = LabelTable::Codes;

TEST(LabelTableTest, eachLengthReadsBackUnderEachIdentifier)
{
    LabelTable table;
    TableMirror mirror(table);
    std::vector<std::size_t> lengths;
    for (std::size_t length = 1; length <= 66; ++length)
        lengths.push_back(length);
    lengths.insert(lengths.end(), {127, 1023, 1024});
    for (const std::size_t length : lengths)
    {
        for (const std::uint32_t identifier : awkward)
            ASSERT_TRUE(table.setCodes(identifier, sequence(length, identifier % 63, 63)));
        mirror.take();
        for (const std::uint32_t identifier : awkward)
            ASSERT_EQ(mirror.codesOf(identifier), sequence(length, identifier % 63, 63))
                << "identifier " << identifier << ", length " << length;
    }
    EXPECT_TRUE(mirror.isSparse());
    EXPECT_EQ(mirror.codesOf(2), Codes());
}

TEST(LabelTableTest, eachWidthOfCodesReadsBack)
{
    for (unsigned int bits = 1; bits <= 20; ++bits)
    {
        LabelTable table;
        TableMirror mirror(table);
        const std::uint32_t glyphs = 1u << bits;
        for (std::uint32_t id = 1; id <= 200; ++id)
            table.setCodes(id, sequence(id, glyphs - id % glyphs, glyphs));
        table.setCodes(300, Codes{glyphs - 1});
        mirror.take();
        EXPECT_EQ(mirror.layout.bits, bits);
        for (std::uint32_t id = 1; id <= 200; ++id)
            ASSERT_EQ(mirror.codesOf(id), sequence(id, glyphs - id % glyphs, glyphs)) << bits;
    }
}

TEST(LabelTableTest, anotherBitRepacksAllTexts)
{
    LabelTable table;
    TableMirror mirror(table);
    std::map<std::uint32_t, Codes> expected;
    for (unsigned int bits = 1; bits <= 20; ++bits)
    {
        expected[bits] = sequence(70 + bits, (1u << bits) - 1, 1u << bits);
        table.setCodes(bits, expected[bits]);
        mirror.take();
        EXPECT_EQ(mirror.layout.bits, bits);
        for (const auto& [id, codes] : expected)
            ASSERT_EQ(mirror.codesOf(id), codes) << "at " << bits << " bits";
    }
}

TEST(LabelTableTest, sixtyFourGlyphsTakeSixBits)
{
    LabelTable table;
    table.setCodes(1, Codes{63});
    EXPECT_EQ(table.getSizes().bits, 6u);
    table.setCodes(1, Codes{64});
    EXPECT_EQ(table.getSizes().bits, 7u);
}

TEST(LabelTableTest, twoMillionTextsOfTwentyCodesStayUnder38MiB)
{
    constexpr std::uint32_t count = 2'000'000;
    LabelTable table;
    for (std::uint32_t id = 1; id <= count; ++id)
        table.setCodes(id, tag(id));
    const LabelTable::Sizes sizes = table.getSizes();
    EXPECT_EQ(sizes.labels, count);
    EXPECT_EQ(sizes.texts, count);
    EXPECT_EQ(sizes.bits, 6u);
    EXPECT_LE(sizes.textBytes + sizes.rowBytes, std::size_t(38) << 20);
    // The packed data themselves, an index to find equal texts (12 bytes a slot), room to grow.
    EXPECT_LE(sizes.mainBytes, std::size_t(100) << 20);
    RecordProperty("gpuBytes", std::to_string(sizes.textBytes + sizes.rowBytes));
    RecordProperty("mainBytes", std::to_string(sizes.mainBytes));

    TableMirror mirror(table);
    mirror.take();
    EXPECT_FALSE(mirror.isSparse());
    for (std::uint32_t id = 1; id <= count; id += 997)
        ASSERT_EQ(mirror.codesOf(id), tag(id)) << id;
    EXPECT_EQ(mirror.codesOf(count), tag(count));
}

TEST(LabelTableTest, equalTextsAreStoredOnce)
{
    LabelTable table;
    for (std::uint32_t id = 1; id <= 1000; ++id)
        table.setCodes(id, sequence(20, id % 2, 63));
    EXPECT_EQ(table.getSizes().texts, 2u);
    EXPECT_LE(table.getSizes().textBytes, 36u); // 2 x 20 x 6 bits in words
}

TEST(LabelTableTest, identifiersInAnyOrderEndDense)
{
    LabelTable table;
    TableMirror mirror(table);
    for (std::uint32_t id = 100'000; id; --id)
        table.setCodes(id, tag(id));
    mirror.take();
    EXPECT_FALSE(mirror.isSparse());
    for (std::uint32_t id = 1; id <= 100'000; id += 13)
        ASSERT_EQ(mirror.codesOf(id), tag(id));
}

TEST(LabelTableTest, withoutStylesThereIsNoBufferForThem)
{
    LabelTable table;
    TableMirror mirror(table);
    table.setCodes(1, tag(1));
    table.setStyle(1, 0);
    mirror.take();
    EXPECT_EQ(table.getSizes().styleBytes, 0u);
    EXPECT_TRUE(mirror.buffers[2].empty());
}

TEST(LabelTableTest, badInputIsSaidOnceAndChangesNothing)
{
    LabelTable table;
    std::vector<std::string> said;
    table.setMessage([&](const std::string& line) { said.push_back(line); });
    table.setCodes(7, tag(7));
    for (int i = 0; i < 2; ++i)
    {
        EXPECT_FALSE(table.setCodes(0, tag(1)));
        EXPECT_FALSE(table.setCodes(0x80000000u, tag(1)));
        EXPECT_FALSE(table.setCodes(7, Codes{1u << 20}));
        EXPECT_TRUE(table.setCodes(8, sequence(2000, 0, 63)));
    }
    EXPECT_EQ(said,
              (std::vector<std::string>{
                  "osgLabels::LabelTable: identifier 0 is not within 1..2147483647, so its object "
                  "has no label",
                  "osgLabels::LabelTable: glyph code 1048576 is over 1048575, the text of "
                  "identifier 7 stays as it was",
                  "osgLabels::LabelTable: the text of identifier 8 has 2000 glyphs, the first 1024 "
                  "are shown; longer texts are cut without further messages"}));
    EXPECT_EQ(table.getCodes(7), tag(7));
    EXPECT_EQ(table.getCodes(8), sequence(1024, 0, 63));
}

TEST(LabelTableTest, moreCodesThanARowCanNameMakeOffsetsCoarser)
{
    LabelTable table;
    TableMirror mirror(table);
    // 2^26 codes are 65536 texts of 1024; each takes 5 more for its length at 2 bits a code.
    constexpr std::uint32_t count = 70'000;
    const auto text = [](std::uint32_t id)
    {
        Codes codes = sequence(1024, 0, 4);
        for (std::size_t i = 0; i < 16; ++i)
            codes[i] = id >> 2 * i & 3;
        return codes;
    };
    for (std::uint32_t id = 1; id <= count; ++id)
        ASSERT_TRUE(table.setCodes(id, text(id)));
    mirror.take();
    EXPECT_EQ(mirror.layout.shift, 1u);
    for (std::uint32_t id = 1; id <= count; id += 331)
        ASSERT_EQ(mirror.codesOf(id), text(id)) << id;
}
