// SPDX-License-Identifier: MIT
#include <osgLabels/Utf8.h>

namespace osgLabels
{

namespace
{

/// What may follow a first byte: how many bytes, and the range of the first of them, which shuts
/// out overlong forms, surrogates and numbers that are too high.
struct Lead
{
    int following;
    unsigned char low, high;
};

Lead getLead(unsigned char byte)
{
    if (byte >= 0xC2 && byte <= 0xDF)
        return {1, 0x80, 0xBF};
    if (byte >= 0xE0 && byte <= 0xEF)
        return {2, static_cast<unsigned char>(byte == 0xE0 ? 0xA0 : 0x80),
                static_cast<unsigned char>(byte == 0xED ? 0x9F : 0xBF)};
    if (byte >= 0xF0 && byte <= 0xF4)
        return {3, static_cast<unsigned char>(byte == 0xF0 ? 0x90 : 0x80),
                static_cast<unsigned char>(byte == 0xF4 ? 0x8F : 0xBF)};
    return {0, 0, 0};
}

} // namespace

char32_t takeCharacter(const std::string& utf8, std::size_t& position)
{
    const auto first = static_cast<unsigned char>(utf8[position++]);
    if (first < 0x80)
        return first;
    const Lead lead = getLead(first);
    if (!lead.following)
        return ReplacementCharacter;
    char32_t character = first & (0x3Fu >> lead.following);
    for (int i = 0; i < lead.following; ++i)
    {
        const auto byte =
            position < utf8.size() ? static_cast<unsigned char>(utf8[position]) : '\0';
        if (byte < (i ? 0x80 : lead.low) || byte > (i ? 0xBF : lead.high))
            return ReplacementCharacter;
        character = character << 6 | (byte & 0x3Fu);
        ++position;
    }
    return character;
}

std::u32string decodeUtf8(const std::string& utf8)
{
    std::u32string text;
    for (std::size_t position = 0; position < utf8.size();)
        text += takeCharacter(utf8, position);
    return text;
}

} // namespace osgLabels
