// SPDX-License-Identifier: MIT
// Stores of tiles whose bytes follow from a number, so that a test knows what must be there.
#pragma once

#include <osgPagedTexture/TilePack.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace osgPagedTexture
{

inline std::string bytesOfFile(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The tile that a store of this version has there: some encoded, some of one colour, some nothing.
inline TileData sampleTile(const TileKey& key, unsigned int version)
{
    const auto mixed = std::uint32_t(key.x * 7919 + key.y * 104729 + key.level * 1299709);
    if (mixed % 5 == 0)
    {
        return TileData::uniform({std::uint8_t(version), std::uint8_t(mixed), 3, 255});
    }
    if (mixed % 7 == 0)
    {
        return {};
    }
    std::string bytes(1 + mixed % 90, char('a' + version % 26));
    return TileData::encoded(bytes + std::to_string(mixed) + " v" + std::to_string(version));
}

inline TileStoreSettings sampleSettings(std::int64_t side = 600)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(side, side, 66, 1);
    settings.description = "{\"quality\": 85}";
    return settings;
}

/// Of all levels, in the order in which a builder puts them.
inline std::vector<TileKey> tilesOf(const TileGrid& grid)
{
    std::vector<TileKey> keys;
    for (std::int64_t step = 0; step < grid.getRows(0); ++step)
    {
        for (const TileRow& row : grid.getRowsFinishedAt(step))
        {
            for (std::int64_t x = 0; x < grid.getColumns(row.level); ++x)
            {
                keys.push_back({row.level, x, row.y});
            }
        }
    }
    return keys;
}

inline void putAll(TileWriter& writer, const TileGrid& grid, unsigned int version)
{
    for (const TileKey& key : tilesOf(grid))
    {
        const TileData tile = sampleTile(key, version);
        if (tile.kind != TileData::Kind::None)
        {
            writer.put(key, tile);
        }
    }
}

inline void buildSample(const std::string& path, unsigned int version,
                        const TileStoreSettings& settings = sampleSettings(),
                        const TilePackWriter::Options& options = {})
{
    TilePackWriter writer(path, settings, options);
    putAll(writer, settings.grid, version);
    writer.commit();
}

/// The version that all tiles have, -1 where they are not of one version.
inline int versionOf(const TileReader& reader, int versions)
{
    for (int version = 0; version < versions; ++version)
    {
        bool all = true;
        for (const TileKey& key : tilesOf(reader.getSettings().grid))
        {
            all = all && reader.read(key) == sampleTile(key, static_cast<unsigned int>(version));
        }
        if (all)
        {
            return version;
        }
    }
    return -1;
}

} // namespace osgPagedTexture
