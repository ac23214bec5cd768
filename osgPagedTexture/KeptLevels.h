// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasOccupancy.h>
#include <osgPagedTexture/TileBuilder.h>
#include <osgPagedTexture/TilePack.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// The unencoded pixels of the coarser levels of a store, in a packed store of lossless tiles:
/// reads and changes them at any place. Level 0 here is TileBuilder::KeptLevel of the store. One
/// thread.
class KeptLevels
{
public:
    /// Opens the packed store `path` to change it. The builder says how tiles are encoded and which
    /// of them hold anything. Beyond a quarter of the memory in pixels, what is changed is
    /// committed. Throws TileStoreError, also where the store is not the builder's.
    KeptLevels(const std::string& path, TileBuilder& builder, const AtlasOccupancy& occupancy,
               const TileBuildSettings& settings, const TilePackWriter::Options& options);
    ~KeptLevels();

    const TileGrid& getGrid() const { return _grid; }

    /// As many rows of level 0 of a store as make an eighth of the memory in pixels of KeptLevel: a
    /// multiple of the rows that a tile of it shows.
    static std::int64_t rowsAtATime(const TileGrid& store, const TileBuildSettings& settings);

    /// Sets pixels of a level, `area` inside of it, the top row first.
    void write(int level, const PixelRect& area, const std::uint8_t* pixels);
    /// Gets pixels, where `area` reaches beyond the level those of its edge.
    void read(int level, const PixelRect& area, std::vector<std::uint8_t>& pixels);
    /// Makes the coarser levels from changed pixels of a level, down to the last one.
    void makeCoarser(int level, PixelRect changed);
    /// A tile of the store, of KeptLevel or coarser, as TileBuilder::build() makes it.
    TileData makeTile(const TileKey& key);
    /// Makes what was changed last, and sets the store's description.
    void commit(const std::string& description);

private:
    struct Tile
    {
        std::vector<std::uint8_t> pixels; ///< A payload's square, the top row first.
        bool changed = false;
    };
    using Key = std::pair<int, std::pair<std::int64_t, std::int64_t>>; ///< Level, y, x.
    Tile& tileAt(int level, std::int64_t x, std::int64_t y);
    Tile load(const TileKey& key) const;
    void put(const TileKey& key, Tile& tile);
    TileData encode(const std::vector<std::uint8_t>& pixels, int width, int height,
                    bool kept) const;
    void putChanged();
    void makeRoom();
    template <typename Visit>
    void forEachTile(int level, const PixelRect& area, const Visit& visit);

    const std::string _path;
    TileBuilder& _builder;
    const AtlasOccupancy& _occupancy;
    const TileColor _background;
    const bool _linearLight;
    const std::size_t _channels;
    const std::size_t _maxTiles;
    TileGrid _grid;
    std::unique_ptr<TilePackWriter> _writer;
    std::unique_ptr<TilePackReader> _reader;
    std::map<Key, Tile> _tiles;
};

} // namespace osgPagedTexture
