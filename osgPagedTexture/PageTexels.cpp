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
    const Pixels pixels = decodeTile(tile.bytes, name);
    const PixelRect place = grid.getPixels(key);
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
