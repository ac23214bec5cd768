// SPDX-License-Identifier: MIT
#include <osgLabels/Utf8.h>

#include <gtest/gtest.h>

using osgLabels::decodeUtf8;

TEST(Utf8Test, charactersOfEachLengthAreDecoded)
{
    EXPECT_EQ(decodeUtf8("a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80"), U"a\u00E9\u20AC\U0001F600");
    EXPECT_EQ(decodeUtf8(std::string("\0x", 2)), std::u32string(U"\0x", 2));
    EXPECT_EQ(decodeUtf8("\xF4\x8F\xBF\xBF"), U"\U0010FFFF");
}

TEST(Utf8Test, bytesThatBeginNoCharacterAreReplaced)
{
    EXPECT_EQ(decodeUtf8("a\x80z"), U"a\uFFFDz");
    EXPECT_EQ(decodeUtf8("\xFF\xFE"), U"\uFFFD\uFFFD");
}

TEST(Utf8Test, aCutOffCharacterIsReplacedOnce)
{
    EXPECT_EQ(decodeUtf8("\xE2\x82"), U"\uFFFD");
    EXPECT_EQ(decodeUtf8("\xF0\x9F\x98z"), U"\uFFFDz");
    EXPECT_EQ(decodeUtf8("\xC3"), U"\uFFFD");
}

TEST(Utf8Test, overlongFormsSurrogatesAndTooHighNumbersAreNoCharacters)
{
    EXPECT_EQ(decodeUtf8("\xC0\xAF"), U"\uFFFD\uFFFD");
    EXPECT_EQ(decodeUtf8("\xE0\x80\xAF"), U"\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(decodeUtf8("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(decodeUtf8("\xF4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD\uFFFD");
}

TEST(Utf8Test, anyBytesAreDecodedWithinTheText)
{
    for (unsigned int first = 0; first < 256; ++first)
        for (unsigned int second = 0; second < 256; ++second)
        {
            const std::string text{static_cast<char>(first), static_cast<char>(second)};
            const std::u32string characters = decodeUtf8(text);
            EXPECT_GE(characters.size(), 1u);
            EXPECT_LE(characters.size(), 2u);
        }
}
