// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileShards.h>

#include <osgPagedTexture/KeptLevels.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;

std::string folderOf(const std::string& path)
{
    return fs::path(path).parent_path().string();
}

[[noreturn]] void refuse(const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused, "osgPagedTexture::TileShards: " + what);
}

/// Rows of level 0 of which the parts are made: those of a tile of the kept level.
std::int64_t unitRows(const TileGrid& grid)
{
    return std::int64_t(grid.getPayload()) << TileBuilder::KeptLevel;
}

/// The first row of level 0 of a part.
std::int64_t firstRow(const TileGrid& grid, const TileShard& shard)
{
    const std::int64_t units = (grid.getHeight() + unitRows(grid) - 1) / unitRows(grid);
    return std::min(units * shard.index / shard.count * unitRows(grid), grid.getHeight());
}

void checkShard(const TileShard& shard)
{
    if (shard.count < 1 || shard.count > 9999 || shard.index < 0 || shard.index >= shard.count)
    {
        refuse("part " + std::to_string(shard.index + 1) + " of " + std::to_string(shard.count) +
               " is none; there are 9999 at most");
    }
}

void removeStore(const std::string& path)
{
    std::error_code ignored; // what is left over does no harm
    fs::remove(path, ignored);
    fs::remove(path + ".lock", ignored);
}

/// Puts the parts' coarse pixels together and makes the levels above them.
class Merge
{
public:
    Merge(const std::string& path, int count, const TilePackWriter::Options& options)
        : _path(path), _temporary(path + ".merging"), _options(options)
    {
        for (int i = 0; i < count; ++i)
        {
            _shards.push_back(std::make_unique<TilePackReader>(TileShard{i, count}.path(path)));
            if (_shards[std::size_t(i)]->getSettings().description !=
                _shards[0]->getSettings().description)
            {
                refuse("the parts '" + TileShard{i, count}.path(path) + "' and '" +
                       TileShard{0, count}.path(path) +
                       "' were built in different ways; build them again");
            }
        }
        _origin = TileStoreOrigin::parse(_shards[0]->getSettings().description);
        const std::string layoutPath = (fs::path(folderOf(path)) / _origin.layout).string();
        _lock = std::make_unique<AtlasLock>(layoutPath, options.waitSeconds);
        _layout = readAtlasLayout(layoutPath);
        if (_layout.getContentHash() != _origin.layoutHash)
        {
            refuse("'" + layoutPath + "' has changed since the parts were built; build them again");
        }
        _builder = std::make_unique<TileBuilder>(_layout, folderOf(path), _origin.settings);
        _occupancy = std::make_unique<AtlasOccupancy>(_layout);
    }

    TileMergeReport run()
    {
        TileStoreSettings keptSettings;
        std::unique_ptr<TilePackWriter> kept;
        if (_builder->getKeptSettings(keptSettings))
        {
            keptSettings.description = _origin.text();
            mergeKept(keptSettings);
            kept = std::make_unique<TilePackWriter>(keptPathOf(_path), keptSettings, _options);
            copyTiles(TilePackReader(keptPathOf(_temporary)), *kept);
        }
        TileStoreSettings settings = _shards[0]->getSettings();
        TilePackWriter store(_path, settings, _options);
        putAll(store);
        if (kept)
        {
            kept->commit();
        }
        store.commit();
        removeParts();
        return _report;
    }

private:
    void mergeKept(const TileStoreSettings& settings)
    {
        TilePackWriter::Options options = _options;
        options.durable = false; // it is written once more
        const std::string path = keptPathOf(_temporary);
        {
            TilePackWriter writer(path, settings, options);
            for (std::size_t i = 0; i < _shards.size(); ++i)
            {
                const TilePackReader part(
                    keptPathOf(TileShard{int(i), int(_shards.size())}.path(_path)));
                for (std::int64_t y = 0; y < settings.grid.getRows(0); ++y)
                {
                    part.forEachInRow({0, y},
                                      [&](std::int64_t x, const TileData& tile) {
                                          writer.put({0, x, y}, tile);
                                      });
                }
            }
            writer.commit();
        }
        _kept =
            std::make_unique<KeptLevels>(path, *_builder, *_occupancy, _origin.settings, options);
        const std::int64_t rows = 2 * settings.grid.getPayload();
        for (std::int64_t y = 0; y < settings.grid.getHeight(); y += rows)
        {
            _kept->makeCoarser(
                0, {0, y, settings.grid.getWidth(), std::min(rows, settings.grid.getHeight() - y)});
        }
        _kept->commit(settings.description);
    }

    /// In the order of a build.
    void putAll(TilePackWriter& store)
    {
        const TileGrid& grid = _builder->getGrid();
        for (std::int64_t step = 0; step < grid.getRows(0); ++step)
        {
            for (const TileRow& row : grid.getRowsFinishedAt(step))
            {
                row.level < TileBuilder::KeptLevel ? putFine(row, store) : putCoarse(row, store);
            }
        }
    }

    void put(const TileKey& key, const TileData& tile, TilePackWriter& store)
    {
        if (tile.kind != TileData::Kind::None)
        {
            store.put(key, tile);
            _report.encodedTiles += tile.kind == TileData::Kind::Encoded;
            _report.uniformTiles += tile.kind == TileData::Kind::Uniform;
        }
    }

    void putFine(const TileRow& row, TilePackWriter& store)
    {
        const TileGrid& grid = _builder->getGrid();
        const std::int64_t y = row.y * grid.getPayload() << row.level;
        int shard = 0;
        while (shard + 1 < int(_shards.size()) &&
               firstRow(grid, {shard + 1, int(_shards.size())}) <= y)
        {
            ++shard;
        }
        _shards[std::size_t(shard)]->forEachInRow(row,
                                                  [&](std::int64_t x, const TileData& tile) {
                                                      put({row.level, x, row.y}, tile, store);
                                                  });
    }

    void putCoarse(const TileRow& row, TilePackWriter& store)
    {
        for (std::int64_t x = 0; x < _builder->getGrid().getColumns(row.level); ++x)
        {
            const TileKey key{row.level, x, row.y};
            put(key, _kept->makeTile(key), store);
        }
    }

    void removeParts()
    {
        _kept.reset();
        removeStore(keptPathOf(_temporary));
        const int count = int(_shards.size());
        for (int i = 0; i < count; ++i)
        {
            removeStore(TileShard{i, count}.path(_path));
            removeStore(keptPathOf(TileShard{i, count}.path(_path)));
        }
    }

    const std::string _path, _temporary;
    const TilePackWriter::Options _options;
    std::vector<std::unique_ptr<TilePackReader>> _shards;
    TileStoreOrigin _origin;
    std::unique_ptr<AtlasLock> _lock;
    AtlasLayout _layout;
    std::unique_ptr<TileBuilder> _builder;
    std::unique_ptr<AtlasOccupancy> _occupancy;
    std::unique_ptr<KeptLevels> _kept;
    TileMergeReport _report;
};

} // namespace

std::string TileShard::path(const std::string& storePath) const
{
    return storePath + ".shard-" + std::to_string(index + 1) + "-of-" + std::to_string(count);
}

TileBuildReport buildTileShard(const std::string& storePath, const TileShard& shard,
                               const AtlasLayout& layout, const TileStoreOrigin& origin,
                               const TilePackWriter::Options& options)
{
    checkShard(shard);
    TileBuilder builder(layout, folderOf(storePath), origin.settings);
    const AtlasOccupancy occupancy(layout);
    const TileGrid& grid = builder.getGrid();
    TileStoreSettings settings;
    settings.grid = grid;
    settings.format = origin.settings.format.extension();
    settings.description = origin.text();
    const std::string path = shard.path(storePath);
    TilePackWriter store(path, settings, options);
    TileStoreSettings keptSettings;
    std::unique_ptr<KeptLevels> kept;
    if (builder.getKeptSettings(keptSettings))
    {
        keptSettings.description = settings.description;
        TilePackWriter(keptPathOf(path), keptSettings, options).commit();
        kept = std::make_unique<KeptLevels>(keptPathOf(path), builder, occupancy, origin.settings,
                                            options);
    }
    const std::int64_t rows = KeptLevels::rowsAtATime(grid, origin.settings);
    const std::int64_t end = firstRow(grid, {shard.index + 1, shard.count});
    TileBuildReport report;
    for (std::int64_t y = firstRow(grid, shard); y < end;)
    {
        const std::int64_t next = std::min((y / rows + 1) * rows, end);
        const auto put = [&](const TileKey& key, const TileData& tile)
        {
            const std::int64_t top = key.y * grid.getPayload() << key.level;
            if (top >= y && top < next && tile.kind != TileData::Kind::None)
            {
                store.put(key, tile);
                report.encodedTiles += tile.kind == TileData::Kind::Encoded;
                report.uniformTiles += tile.kind == TileData::Kind::Uniform;
                report.tileBytes += tile.bytes.size();
            }
        };
        LevelPixels coarse;
        const TileBuildReport part =
            builder.rebuild({0, y, grid.getWidth(), next - y}, put, coarse);
        report.failures.insert(report.failures.end(), part.failures.begin(), part.failures.end());
        if (kept)
        {
            kept->write(0, coarse.area, coarse.bytes.data());
        }
        y = next;
    }
    if (kept)
    {
        kept->commit(keptSettings.description);
    }
    store.commit();
    return report;
}

int countTileShards(const std::string& storePath)
{
    const std::string name = fs::path(storePath).filename().string() + ".shard-";
    const std::string folder = folderOf(storePath).empty() ? "." : folderOf(storePath);
    int count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
    {
        const std::string file = entry.path().filename().string();
        const std::size_t of = file.rfind("-of-");
        if (file.compare(0, name.size(), name) != 0 || of == std::string::npos)
        {
            continue;
        }
        int found = 0;
        const char* const end = file.data() + file.size();
        const auto number = std::from_chars(file.data() + of + 4, end, found);
        if (number.ec != std::errc() || number.ptr != end)
        {
            continue; // its pixels or its lock
        }
        if (count != 0 && found != count)
        {
            refuse("beside '" + storePath + "' are parts of several builds, of " +
                   std::to_string(count) + " and of " + std::to_string(found) +
                   "; remove those of one");
        }
        count = found;
    }
    if (count == 0)
    {
        refuse("no part of '" + storePath + "' is there; build them with --shard");
    }
    return count;
}

TileMergeReport mergeTileShards(const std::string& storePath, int count,
                                const TilePackWriter::Options& options)
{
    checkShard({0, count});
    return Merge(storePath, count, options).run();
}

} // namespace osgPagedTexture
