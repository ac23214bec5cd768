// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/FileCheck.h>

#include <algorithm>
#include <cstdint>

namespace osgKitsOiio
{

namespace
{

/// Numbers in a file, whose bytes past the end count as 0.
struct Bytes
{
    const std::string& text;
    bool bigEndian;

    std::uint32_t get(std::uint64_t at, int count) const
    {
        std::uint32_t value = 0;
        for (int i = 0; i < count; ++i)
        {
            const std::uint64_t from = at + (bigEndian ? i : count - 1 - i);
            value = value << 8 | (from < text.size() ? static_cast<unsigned char>(text[from]) : 0);
        }
        return value;
    }
    std::uint16_t get16(std::uint64_t at) const { return static_cast<std::uint16_t>(get(at, 2)); }
    std::uint32_t get32(std::uint64_t at) const { return get(at, 4); }
};

bool startsWith(const std::string& text, std::uint64_t at, const std::string& start)
{
    return at <= text.size() && text.compare(at, start.size(), start) == 0;
}

std::string checkDpx(const std::string& text)
{
    const Bytes bytes{text, startsWith(text, 0, "SDPX")};
    constexpr std::uint32_t undefined = 0xffffffff;
    constexpr std::uint64_t headerBytes = 2048;
    const std::uint32_t userBytes = bytes.get32(32);
    if (userBytes != undefined && userBytes + headerBytes > text.size() && userBytes)
    {
        return "damaged: the user data do not fit into the file";
    }
    return {};
}

constexpr std::uint64_t IcoHeader = 6;
constexpr std::uint64_t IcoEntry = 16;
const char PngSignature[] = "\x89PNG\r\n\x1a\n";

/// OpenImageIO writes a size of 0: then the picture goes on to the end of the file.
std::uint64_t icoPictureBytes(const Bytes& bytes, std::uint64_t entry)
{
    const std::uint64_t size = bytes.get32(entry + 8);
    const std::uint64_t at = bytes.get32(entry + 12);
    return size || at > bytes.text.size() ? size : bytes.text.size() - at;
}

std::string checkIcoBitmap(const Bytes& bytes, std::uint64_t entry, std::uint64_t at,
                           std::uint64_t size)
{
    const auto width = bytes.text[entry] ? static_cast<unsigned char>(bytes.text[entry]) : 256;
    const auto height =
        bytes.text[entry + 1] ? static_cast<unsigned char>(bytes.text[entry + 1]) : 256;
    const std::uint32_t bits = bytes.get16(at + 14);
    if (bytes.get32(at) != 40 ||
        (bits != 1 && bits != 4 && bits != 8 && bits != 24 && bits != 32) ||
        bytes.get32(at + 4) != std::uint32_t(width) || bytes.get32(at + 8) != 2u * height)
    {
        return "damaged: a bitmap's header does not agree with the directory";
    }
    const std::uint64_t palette = bits <= 8 ? 4ull << bits : 0;
    const std::uint64_t colourRow = (width * bits + 31) / 32 * 4;
    const std::uint64_t maskRow = (width + 31) / 32 * 4;
    return 40 + palette + height * (colourRow + maskRow) > size ? "damaged: a bitmap is cut off"
                                                                : "";
}

std::string checkIco(const std::string& text)
{
    const Bytes bytes{text, false};
    const std::uint64_t count = bytes.get16(4);
    if (text.size() < IcoHeader + IcoEntry || bytes.get16(0) != 0 || bytes.get16(2) != 1 ||
        !count || text.size() < IcoHeader + IcoEntry * count)
    {
        return "damaged: no directory of pictures";
    }
    for (std::uint64_t i = 0; i < count; ++i)
    {
        const std::uint64_t entry = IcoHeader + IcoEntry * i;
        const std::uint64_t at = bytes.get32(entry + 12);
        const std::uint64_t size = icoPictureBytes(bytes, entry);
        if (size < 40 || at + size > text.size())
        {
            return "damaged: a picture lies outside the file";
        }
        const std::string error =
            startsWith(text, at, PngSignature) ? "" : checkIcoBitmap(bytes, entry, at, size);
        if (!error.empty())
        {
            return error;
        }
    }
    return {};
}

std::string checkSgi(const std::string& text)
{
    const Bytes bytes{text, true};
    const std::uint64_t rows = std::uint64_t(bytes.get16(8)) * bytes.get16(10);
    const unsigned char storage = text.size() > 2 ? text[2] : 255;
    const unsigned char sampleBytes = text.size() > 3 ? text[3] : 0;
    if (storage > 1 || sampleBytes < 1 || sampleBytes > 2 || !bytes.get16(6) || !rows)
    {
        return "damaged: the header makes no sense";
    }
    constexpr std::uint64_t headerBytes = 512;
    if (storage == 0)
    {
        return headerBytes + rows * bytes.get16(6) * sampleBytes > text.size() ? "damaged: cut off"
                                                                               : "";
    }
    for (std::uint64_t row = 0; row < rows; ++row)
    {
        const std::uint64_t at = bytes.get32(headerBytes + 4 * row);
        const std::uint64_t size = bytes.get32(headerBytes + 4 * (rows + row));
        if (headerBytes + 8 * rows > text.size() || at + size > text.size())
        {
            return "damaged: a row lies outside the file";
        }
    }
    return {};
}

/// How many bytes a run length code of IFF gives; more than limit where it is damaged.
std::uint64_t unpackedBytes(const Bytes& bytes, std::uint64_t& at, std::uint64_t end,
                            std::uint64_t limit)
{
    std::uint64_t unpacked = 0;
    while (at < end && unpacked < limit)
    {
        const std::uint32_t code = bytes.get(at, 1);
        const std::uint64_t count = (code & 0x7f) + 1;
        at += code & 0x80 ? 2 : 1 + count;
        unpacked += count;
    }
    return at > end ? limit + 1 : unpacked;
}

struct IffPicture
{
    int width = 0;
    int height = 0;
    int channelBytes = 0;
    int tileWidth = 0; ///< Of the first tile, which sets the grid.
    int tileHeight = 0;
    std::int64_t tiles = 0;
};

std::string checkIffTile(const Bytes& bytes, std::uint64_t at, std::uint64_t size,
                         IffPicture& picture)
{
    const int left = bytes.get16(at), top = bytes.get16(at + 2);
    const int right = bytes.get16(at + 4), bottom = bytes.get16(at + 6);
    if (!picture.tileWidth && left == 0 && top == 0)
    {
        picture.tileWidth = right + 1;
        picture.tileHeight = bottom + 1;
    }
    if (size < 8 || !picture.tileWidth || left % picture.tileWidth || top % picture.tileHeight ||
        right != std::min(left + picture.tileWidth, picture.width) - 1 ||
        bottom != std::min(top + picture.tileHeight, picture.height) - 1 || right < left ||
        bottom < top)
    {
        return "damaged: a tile lies off the grid";
    }
    ++picture.tiles;
    const std::uint64_t pixels = std::uint64_t(right - left + 1) * (bottom - top + 1);
    std::uint64_t from = at + 8;
    if (size - 8 >= pixels * picture.channelBytes)
    {
        return {}; // stored as it is
    }
    for (int channel = 0; channel < picture.channelBytes; ++channel)
    {
        if (unpackedBytes(bytes, from, at + size, pixels) != pixels)
        {
            return "damaged: a tile is not as long as its size says";
        }
    }
    return {};
}

std::string checkIff(const std::string& text)
{
    const Bytes bytes{text, true};
    if (!startsWith(text, 0, "FOR4") || !startsWith(text, 8, "CIMG"))
    {
        return "not an IFF picture";
    }
    IffPicture picture;
    for (std::uint64_t at = 12; at + 8 <= text.size();)
    {
        const std::uint64_t size = bytes.get32(at + 4);
        // The list of tiles holds them and ends with the file.
        if (startsWith(text, at, "FOR4"))
        {
            at += 12;
            continue;
        }
        if (at + 8 + size > text.size())
        {
            return "damaged: a chunk lies outside the file";
        }
        if (startsWith(text, at, "TBHD"))
        {
            picture.width = static_cast<int>(bytes.get32(at + 8));
            picture.height = static_cast<int>(bytes.get32(at + 12));
            const std::uint32_t flags = bytes.get32(at + 20);
            const int sampleBytes = bytes.get16(at + 24) ? 2 : 1;
            picture.channelBytes = (flags & 2 ? 4 : 3) * sampleBytes;
            constexpr std::uint32_t largest = 0xffff;
            if (size < 24 ||
                (size >= 32 && (bytes.get32(at + 32) | bytes.get32(at + 36)) > largest) ||
                !(flags & 1) || bytes.get32(at + 8) - 1 >= largest ||
                bytes.get32(at + 12) - 1 >= largest)
            {
                return "damaged: the header makes no sense";
            }
        }
        else if (startsWith(text, at, "RGBA"))
        {
            const std::string error = checkIffTile(bytes, at + 8, size, picture);
            if (!error.empty())
            {
                return error;
            }
        }
        at += 8 + (size + 3) / 4 * 4;
    }
    const auto share = [](std::int64_t whole, std::int64_t part)
    { return part ? (whole + part - 1) / part : 0; };
    if (!picture.tiles || picture.tiles != share(picture.width, picture.tileWidth) *
                                               share(picture.height, picture.tileHeight))
    {
        return "damaged: tiles are missing";
    }
    return {};
}

} // namespace

bool isCheckedForDamage(const std::string& format)
{
    return format == "dpx" || format == "ico" || format == "iff" || format == "sgi";
}

std::string findDamage(const std::string& format, const std::string& bytes)
{
    if (format == "dpx")
    {
        return checkDpx(bytes);
    }
    if (format == "ico")
    {
        return checkIco(bytes);
    }
    if (format == "iff")
    {
        return checkIff(bytes);
    }
    return format == "sgi" ? checkSgi(bytes) : std::string();
}

std::string extractPng(const std::string& icoBytes)
{
    const Bytes bytes{icoBytes, false};
    const std::uint64_t at = bytes.get32(IcoHeader + 12);
    return startsWith(icoBytes, at, PngSignature)
               ? icoBytes.substr(at, icoPictureBytes(bytes, IcoHeader))
               : std::string();
}

} // namespace osgKitsOiio
