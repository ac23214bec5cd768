// SPDX-License-Identifier: MIT
#include <osgPagedTexture/DdsFile.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

constexpr std::uint32_t Magic = 0x4354676f; // "ogTC"
constexpr std::uint32_t Version = 1;
constexpr std::size_t PlainHeaderBytes = 128;
constexpr std::size_t ReservedWord = 8; ///< Of the words after "DDS ".
constexpr int MaxSide = 1 << 20;

/// DDS_PIXELFORMAT, with four letters or with masks.
struct PixelFormat
{
    std::uint32_t flags;
    const char* letters;
    std::uint32_t bits;
    std::uint32_t masks[4];
};

constexpr std::uint32_t AlphaFlag = 0x1, LettersFlag = 0x4, ColourFlag = 0x40,
                        LuminanceFlag = 0x20000;
constexpr std::uint32_t DxgiBc7 = 98;

const PixelFormat& pixelFormat(BlockFormat format)
{
    static const PixelFormat formats[] = {
        {LuminanceFlag, nullptr, 8, {0xff, 0, 0, 0}},
        {LuminanceFlag | AlphaFlag, nullptr, 16, {0xff, 0, 0, 0xff00}},
        {ColourFlag, nullptr, 24, {0xff, 0xff00, 0xff0000, 0}},
        {ColourFlag | AlphaFlag, nullptr, 32, {0xff, 0xff00, 0xff0000, 0xff000000}},
        {LettersFlag, "DXT1", 0, {}},
        {LettersFlag, "DXT5", 0, {}},
        {LettersFlag, "ATI1", 0, {}},
        {LettersFlag, "ATI2", 0, {}},
        {LettersFlag, "DX10", 0, {}}};
    return formats[static_cast<int>(format)];
}

void putWord(std::string& text, std::uint32_t value)
{
    for (int shift = 0; shift < 32; shift += 8)
    {
        text.push_back(static_cast<char>(value >> shift & 0xff));
    }
}

void putLong(std::string& text, std::uint64_t value)
{
    putWord(text, static_cast<std::uint32_t>(value));
    putWord(text, static_cast<std::uint32_t>(value >> 32));
}

std::uint32_t getWord(const std::string& text, std::size_t at)
{
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
    {
        value = value << 8 | static_cast<unsigned char>(text[at + i]);
    }
    return value;
}

std::uint64_t getLong(const std::string& text, std::size_t at)
{
    return getWord(text, at) | std::uint64_t(getWord(text, at + 4)) << 32;
}

void putPixelFormat(std::string& text, const PixelFormat& format)
{
    putWord(text, 32);
    putWord(text, format.flags);
    text += format.letters ? std::string(format.letters) : std::string(4, '\0');
    putWord(text, format.bits);
    for (std::uint32_t mask : format.masks)
    {
        putWord(text, mask);
    }
}

std::optional<BlockFormat> findFormat(const std::string& head)
{
    for (int i = 0; i <= static_cast<int>(BlockFormat::BC7); ++i)
    {
        std::string text;
        putPixelFormat(text, pixelFormat(static_cast<BlockFormat>(i)));
        constexpr std::size_t pixelFormatAt = 76;
        if (head.compare(pixelFormatAt, text.size(), text) == 0)
        {
            return static_cast<BlockFormat>(i);
        }
    }
    return {};
}

/// All of it. `reserved`: the words that DDS has no use for, up to 44 bytes.
std::string ddsHead(BlockFormat format, int width, int height, int levels, std::string reserved)
{
    constexpr std::uint32_t caps = 0x1, heightWidth = 0x6, pitch = 0x8, pixelFormatFlag = 0x1000,
                            mipCount = 0x20000, linearSize = 0x80000;
    const std::uint64_t size = isBlocked(format) ? levelBytes(format, width, height)
                                                 : std::uint64_t(width) * unitBytes(format);
    std::string text = "DDS ";
    putWord(text, 124);
    putWord(text, caps | heightWidth | pixelFormatFlag | mipCount |
                      (isBlocked(format) ? linearSize : pitch));
    putWord(text, static_cast<std::uint32_t>(height));
    putWord(text, static_cast<std::uint32_t>(width));
    putWord(text, static_cast<std::uint32_t>(size));
    putWord(text, 0); // depth
    putWord(text, static_cast<std::uint32_t>(levels));
    reserved.resize(11 * sizeof(std::uint32_t), '\0');
    text += reserved;
    putPixelFormat(text, pixelFormat(format));
    constexpr std::uint32_t complex = 0x8, texture = 0x1000, mipmap = 0x400000;
    putWord(text, texture | (levels > 1 ? complex | mipmap : 0));
    text.append(4 * sizeof(std::uint32_t), '\0'); // caps 2 to 4, reserved
    if (format == BlockFormat::BC7)
    {
        constexpr std::uint32_t texture2d = 3, arraySize = 1;
        for (std::uint32_t word : {DxgiBc7, texture2d, 0u, arraySize, 0u})
        {
            putWord(text, word);
        }
    }
    return text;
}

} // namespace

std::size_t ChainFileLayout::headerBytes() const
{
    return format == BlockFormat::BC7 ? MaxChainHeaderBytes : PlainHeaderBytes;
}

std::uint64_t ChainFileLayout::levelOffset(int level) const
{
    return headerBytes() + chainBytes(format, width, height, firstLevel) -
           (level < firstLevel + levels() ? chainBytes(format, width, height, level) : 0);
}

std::uint64_t ChainFileLayout::fileBytes() const
{
    return tableOffset() + sizeof(std::uint64_t) * levels();
}

std::uint64_t ChainFileLayout::checksumOf(const char* table) const
{
    // The header has a part in it: sizes whose coarse levels are alike differ in nothing else.
    ChainFileLayout unsealed = *this;
    unsealed.tableChecksum = 0;
    const std::string text = unsealed.header();
    return checksum(table, sizeof(std::uint64_t) * levels(), checksum(text.data(), text.size()));
}

std::string ChainFileLayout::header() const
{
    std::string reserved;
    for (std::uint32_t word :
         {Magic, Version, std::uint32_t(width), std::uint32_t(height), std::uint32_t(firstLevel)})
    {
        putWord(reserved, word);
    }
    putLong(reserved, tableChecksum);
    putLong(reserved, key.low);
    putLong(reserved, key.high);
    return ddsHead(format, levelSide(width, firstLevel), levelSide(height, firstLevel), levels(),
                   reserved);
}

std::string ddsHeader(BlockFormat format, int width, int height)
{
    return ddsHead(format, width, height, 1, {});
}

std::optional<ChainFileLayout> parseChainHeader(const std::string& head, std::uint64_t fileBytes)
{
    if (head.size() < PlainHeaderBytes)
    {
        return {};
    }
    const auto format = findFormat(head);
    const auto word = [&](std::size_t index) { return getWord(head, 4 * (ReservedWord + index)); };
    ChainFileLayout layout;
    layout.width = static_cast<int>(std::min<std::uint32_t>(word(2), MaxSide + 1));
    layout.height = static_cast<int>(std::min<std::uint32_t>(word(3), MaxSide + 1));
    if (!format || layout.width < 1 || layout.height < 1 ||
        std::max(layout.width, layout.height) > MaxSide ||
        word(4) >= std::uint32_t(levelCount(layout.width, layout.height)))
    {
        return {};
    }
    layout.format = *format;
    layout.firstLevel = static_cast<int>(word(4));
    layout.tableChecksum = getLong(head, 4 * (ReservedWord + 5));
    layout.key.low = getLong(head, 4 * (ReservedWord + 7));
    layout.key.high = getLong(head, 4 * (ReservedWord + 9));
    const std::string expected = layout.header();
    if (layout.fileBytes() != fileBytes || head.compare(0, expected.size(), expected) != 0)
    {
        return {};
    }
    return layout;
}

std::uint64_t levelChecksum(const ContentHash& key, int level,
                            const std::vector<std::uint8_t>& bytes)
{
    return checksum(bytes.data(), bytes.size(), key.low ^ key.high ^ std::uint64_t(level));
}

bool writeChainFile(const ContentHash& key, const MipChain& chain, const WriteBytes& write)
{
    std::string table;
    for (std::size_t i = 0; i < chain.levels.size(); ++i)
    {
        putLong(table, levelChecksum(key, chain.firstLevel + static_cast<int>(i), chain.levels[i]));
    }
    ChainFileLayout layout{chain.format, chain.width, chain.height, chain.firstLevel, key, 0};
    layout.tableChecksum = layout.checksumOf(table.data());
    const std::string header = layout.header();
    return write(header.data(), header.size()) &&
           std::all_of(chain.levels.begin(), chain.levels.end(),
                       [&write](const std::vector<std::uint8_t>& level)
                       { return write(level.data(), level.size()); }) &&
           write(table.data(), table.size());
}

std::optional<MipChain> readChainTail(const ChainFileLayout& layout, int firstLevel,
                                      const ReadBytes& read)
{
    MipChain chain{layout.format, layout.width, layout.height, firstLevel, {}};
    std::string checksums;
    for (int level = firstLevel; level < layout.firstLevel + layout.levels(); ++level)
    {
        std::vector<std::uint8_t> bytes(layout.levelOffset(level + 1) - layout.levelOffset(level));
        if (!read(bytes.data(), bytes.size()))
        {
            return {};
        }
        putLong(checksums, levelChecksum(layout.key, level, bytes));
        chain.levels.push_back(std::move(bytes));
    }
    std::string table(sizeof(std::uint64_t) * std::size_t(layout.levels()), '\0');
    const std::size_t skipped = table.size() - checksums.size();
    if (!read(table.data(), table.size()) ||
        layout.checksumOf(table.data()) != layout.tableChecksum ||
        table.compare(skipped, std::string::npos, checksums) != 0)
    {
        return {};
    }
    return chain;
}

} // namespace osgPagedTexture
