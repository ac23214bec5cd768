// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageTexels.h>
#include <osgPagedTexture/TileExtract.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

/// The tile in the middle of a square, its edges repeated, the top row first.
Pixels fillSquare(const Pixels& tile, int side, int left, int top)
{
    Pixels square(side, side, tile.channels);
    const auto channels = std::size_t(tile.channels);
    for (int y = 0; y < side; ++y)
    {
        const int fromTop = std::clamp(y - top, 0, tile.height - 1);
        const std::uint8_t* from = tile.row(tile.height - 1 - fromTop);
        std::uint8_t* to = square.row(y);
        for (int x = 0; x < left; ++x)
        {
            std::copy_n(from, channels, to + std::size_t(x) * channels);
        }
        const int width = std::min(tile.width, side - left);
        std::copy_n(from, std::size_t(width) * channels, to + std::size_t(left) * channels);
        for (int x = left + width; x < side; ++x)
        {
            std::copy_n(from + std::size_t(tile.width - 1) * channels, channels,
                        to + std::size_t(x) * channels);
        }
    }
    return square;
}

std::uint32_t wordAt(const std::string& bytes, std::size_t place)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
        word |= std::uint32_t(std::uint8_t(bytes[place + i])) << 8 * i;
    }
    return word;
}

/// The blocks of a DDS file of that side and format, whose rows lie as a page's; else empty.
PageTexels blocksOfDds(const std::string& bytes, const PageFormat& format)
{
    constexpr std::size_t headerBytes = 128;
    constexpr std::size_t dx10Bytes = 20;
    constexpr std::uint32_t dxt1 = 0x31545844, dxt5 = 0x35545844, dx10 = 0x30315844;
    constexpr std::uint32_t bc7 = 98, bc7Srgb = 99; // DXGI_FORMAT
    if (bytes.size() < headerBytes + dx10Bytes || bytes.compare(0, 4, "DDS ") != 0 ||
        wordAt(bytes, 12) != std::uint32_t(format.side) ||
        wordAt(bytes, 16) != std::uint32_t(format.side))
    {
        return {};
    }
    const std::uint32_t code = wordAt(bytes, 84);
    const std::uint32_t extended = code == dx10 ? wordAt(bytes, headerBytes) : 0;
    const bool isAlike =
        (format.format == BlockFormat::BC1 && code == dxt1) ||
        (format.format == BlockFormat::BC3 && code == dxt5) ||
        (format.format == BlockFormat::BC7 && (extended == bc7 || extended == bc7Srgb));
    const std::size_t start = headerBytes + (code == dx10 ? dx10Bytes : 0);
    if (!isAlike || bytes.size() - start < format.bytes())
    {
        return {};
    }
    const auto first = bytes.begin() + std::ptrdiff_t(start);
    return {first, first + std::ptrdiff_t(format.bytes())};
}

Pixels fillColor(const TileColor& color, int side)
{
    Pixels square(side, side, 4);
    for (std::size_t i = 0; i < square.bytes.size(); ++i)
    {
        square.bytes[i] = color[i % 4];
    }
    return square;
}

} // namespace

BlockFormat pageFormatOf(const TileStoreSettings& store)
{
    const bool isOpaque = store.format == "jpg" || store.format == "jpeg";
    return isOpaque ? BlockFormat::BC1 : BlockFormat::BC7;
}

int pageSideOf(const TileGrid& grid, BlockFormat format)
{
    const int side = grid.getTileSide();
    return isBlocked(format) ? (side + 3) / 4 * 4 : side;
}

PageTexels makePage(const TileData& tile, const TileGrid& grid, const TileKey& key,
                    const PageFormat& format, const std::string& name)
{
    if (tile.kind != TileData::Kind::Encoded)
    {
        const bool isThere = tile.kind == TileData::Kind::Uniform;
        return encodeBlocks(fillColor(isThere ? tile.color : format.background, format.side),
                            format.format, format.quality);
    }
    const PixelRect place = grid.getPixels(key);
    if (place.width == format.side && place.height == format.side)
    {
        PageTexels blocks = blocksOfDds(tile.bytes, format);
        if (!blocks.empty())
        {
            return blocks;
        }
    }
    const Pixels pixels = decodeTile(tile.bytes, name);
    if (pixels.width != place.width || pixels.height != place.height)
    {
        throw TileStoreError(TileStoreError::Kind::Damaged,
                             "osgPagedTexture::VirtualPager: " + name + " has " +
                                 std::to_string(pixels.width) + " x " +
                                 std::to_string(pixels.height) + " pixels instead of " +
                                 std::to_string(place.width) + " x " +
                                 std::to_string(place.height) + "; build the store anew");
    }
    const auto left = int(place.x - (key.x * grid.getPayload() - grid.getBorder()));
    const auto top = int(place.y - (key.y * grid.getPayload() - grid.getBorder()));
    return encodeBlocks(fillSquare(pixels, format.side, left, top), format.format, format.quality);
}

} // namespace osgPagedTexture
