// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/LevelRows.h>
#include <osgPagedTexture/TileEncoder.h>
#include <osgPagedTexture/TileWalk.h>

#include <map>

namespace osgPagedTexture
{

class JpegCutter;

/// How far a walk is with the tiles of one grid, and how they come of its rows.
class WalkOutputRows
{
public:
    WalkOutputRows(WalkOutput output, unsigned int members);

    /// Says that a photograph lies there, in pixels of level 0 of the walk: tiles without any are
    /// nothing. To be called before their rows are finished.
    void markOccupied(const PixelRect& covered);

    using Visit = std::function<void(const TileKey& key, bool occupied)>;
    /// Visits the wanted tiles whose rows are there since the last call.
    void forEachFinished(const std::vector<LevelRows>& rows, const Visit& visit);

    /// Whether such a tile may be cut out of a photograph.
    bool isCut(const TileKey& key) const
    {
        return _output.firstLevel == 0 && key.level == 0 &&
               _output.format.coding == TileCoding::Jpeg;
    }
    PixelRect getPixels(const TileKey& key) const { return _output.grid.getPixels(key); }

    /// `member` counts the threads that do so at once. With a cutter the tile is that part of its
    /// photograph unless it is uniform.
    TileData encode(const TileKey& key, const std::vector<LevelRows>& rows, unsigned int member,
                    const JpegCutter* cutter, const PixelRect& part);
    void put(const TileKey& key, const TileData& tile) const { _output.put(key, tile); }

private:
    using Columns = std::vector<bool>;
    struct Member
    {
        std::unique_ptr<TileEncoder> encoder;
        std::vector<const std::uint8_t*> rows;
        std::vector<std::uint8_t> pixels; ///< Of the tile.
    };
    void gather(const PixelRect& area, int level, const LevelRows& rows, Member& member) const;

    const WalkOutput _output;
    std::vector<std::int64_t> _next;                      ///< Row of tiles, by level.
    std::vector<std::map<std::int64_t, Columns>> _marked; ///< By level and row.
    std::vector<Member> _members;
};

} // namespace osgPagedTexture
