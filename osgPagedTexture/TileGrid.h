// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// A tile's place in a pyramid: level 0 is the full size, x counts from the left, y from the top.
struct TileKey
{
    int level = 0;
    std::int64_t x = 0;
    std::int64_t y = 0;

    bool operator==(const TileKey& other) const
    {
        return level == other.level && x == other.x && y == other.y;
    }
};

/// Pixels of a level, from its top left corner.
struct PixelRect
{
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t width = 0;
    std::int64_t height = 0;
};

/// A row of tiles of a level.
struct TileRow
{
    int level = 0;
    std::int64_t y = 0;
};

/// Tiles x to lastX, y to lastY of a level, all included.
struct TileRange
{
    int level = 0;
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t lastX = -1; ///< Less than x: no tile.
    std::int64_t lastY = -1;
};

/// The numbers of a tile pyramid over a picture of any size. Each level is half of the one below,
/// rounded up, so that a texel of level L + 1 always comes from the pair of rows and columns that
/// starts at twice its place; the last pair may be a single one. All in 64 bits; any thread.
class OSGPAGEDTEXTURE_EXPORT TileGrid
{
public:
    enum class Edge
    {
        Padded, ///< Every tile has the full side; what lies outside repeats the picture's edge.
        Clipped ///< Tiles end with the picture, as in Deep Zoom; the levels go down to 1 x 1.
    };
    static constexpr std::int64_t MaxSide = std::int64_t(1) << 40; ///< Of the picture, in pixels.

    /// `tileSide` is a tile's payload and its border on both sides, in pixels. Throws
    /// TileStoreError where a side is not in 1..MaxSide, the payload is not in 1..65536, or where
    /// there were more than 2^29 tiles in a row.
    TileGrid(std::int64_t width, std::int64_t height, int tileSide, int border,
             Edge edge = Edge::Padded);
    TileGrid() : TileGrid(1, 1, 1, 0) {}

    std::int64_t getWidth(int level = 0) const; ///< Of a level, in pixels.
    std::int64_t getHeight(int level = 0) const;
    int getTileSide() const { return _payload + 2 * _border; }
    int getPayload() const { return _payload; } ///< Distance of two tiles, in pixels.
    int getBorder() const { return _border; }
    Edge getEdge() const { return _edge; }

    /// From the full size down to a single tile (Padded) or a single pixel (Clipped).
    int getLevels() const { return _levels; }
    std::int64_t getColumns(int level) const;
    std::int64_t getRows(int level) const;
    std::uint64_t getTileCount(int level) const;
    std::uint64_t getTileCount() const; ///< Of all levels.
    bool contains(const TileKey& key) const;

    /// A tile's pixels with its border; reaches beyond the picture where the edge is Padded.
    PixelRect getPixels(const TileKey& key) const;
    /// A tile's pixels without border, inside the picture.
    PixelRect getPayloadPixels(const TileKey& key) const;

    /// The tile of the next level that covers it; not for the last level.
    TileKey getParent(const TileKey& key) const { return {key.level + 1, key.x / 2, key.y / 2}; }

    /// The tiles of a level whose pixels, border included, hold any of these pixels of level 0.
    TileRange getTouched(const PixelRect& pixels, int level) const;

    /// The order in which a walk down the picture can finish rows of tiles: step s is when the
    /// first (s + 1) * payload rows of level 0 are there. Each row is finished as soon as all its
    /// pixels, border included, are. There are getRows(0) steps. A packed store is compact when its
    /// tiles lie in this order, x ascending in each row.
    std::vector<TileRow> getRowsFinishedAt(std::int64_t step) const;

    bool operator==(const TileGrid& other) const;
    bool operator!=(const TileGrid& other) const { return !(*this == other); }

private:
    std::int64_t getStep(const TileRow& row) const;

    std::int64_t _width;
    std::int64_t _height;
    int _payload;
    int _border;
    Edge _edge;
    int _levels;
};

} // namespace osgPagedTexture
