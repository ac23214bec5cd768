// SPDX-License-Identifier: MIT
// Tiles a second into and out of a packed store, with and without waiting for the disk, beside the
// same tiles as files of their own.
#include <osgPagedTexture/TileFolders.h>
#include <osgPagedTexture/TilePack.h>

#include <support/TemporaryFolder.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

using namespace osgPagedTexture;

namespace
{

/// A tile of 128 pixels as JPEG has about as many.
constexpr std::size_t TileBytes = 2600;
constexpr int Rounds = 5;

TileStoreSettings settingsOf(TileGrid::Edge edge)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(64 * 128, 64 * 128, 130, 1, edge);
    return settings;
}

double secondsOf(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<TileKey> keysOf(const TileGrid& grid)
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

} // namespace

int main()
{
    const support::TemporaryFolder folder;
    const TileStoreSettings settings = settingsOf(TileGrid::Edge::Padded);
    const std::vector<TileKey> keys = keysOf(settings.grid);
    std::vector<TileKey> shuffled = keys;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
    std::mt19937 random(1);
    std::string bytes(TileBytes, '\0');
    std::generate(bytes.begin(), bytes.end(), [&]() { return char(random()); });
    const TileData tile = TileData::encoded(bytes);
    const std::string pack = folder.file("store.tiles");
    const auto putAll = [&](TileWriter& writer)
    {
        for (const TileKey& key : keys)
        {
            writer.put(key, tile);
        }
        writer.commit();
    };
    const auto build = [&](bool durable)
    {
        TilePackWriter::Options options;
        options.durable = durable;
        TilePackWriter writer(pack, settings, options);
        putAll(writer);
    };
    struct Work
    {
        std::string name;
        std::function<std::size_t()> run; ///< Returns how many tiles it has dealt with.
    };
    const std::vector<Work> works = {
        {"pack, no sync", [&]() { return build(false), keys.size(); }},
        {"pack, synced", [&]() { return build(true), keys.size(); }},
        {"pack, read in order",
         [&]()
         {
             const TilePackReader reader(pack);
             std::for_each(keys.begin(), keys.end(), [&](const TileKey& key) { reader.read(key); });
             return keys.size();
         }},
        {"pack, read at random",
         [&]()
         {
             const TilePackReader reader(pack);
             std::for_each(shuffled.begin(), shuffled.end(),
                           [&](const TileKey& key) { reader.read(key); });
             return keys.size();
         }},
        {"pack, verified", [&]() { return TilePackReader(pack).verify().size() + keys.size(); }},
        {"pack, update of 20 tiles, synced",
         [&]()
         {
             TilePackWriter writer(pack, {});
             std::for_each(shuffled.begin(), shuffled.begin() + 20,
                           [&](const TileKey& key) { writer.put(key, tile); });
             writer.commit();
             return std::size_t(20);
         }},
        {"pack, compacted, synced", [&]() { return compactTilePack(pack), keys.size(); }},
        {"LibVT folders, no sync",
         [&]()
         {
             TileFolderWriter writer(folder.file("libvt"), FolderLayout::LibVT, settings, {});
             putAll(writer);
             return keys.size();
         }},
        {"LibVT folders, one sync at the end",
         [&]()
         {
             TileFolderWriter writer(folder.file("libvt"), FolderLayout::LibVT, settings, {});
             putAll(writer);
             sync();
             return keys.size();
         }},
    };
    std::map<std::string, std::vector<double>> rates;
    for (int round = 0; round < Rounds; ++round)
    {
        for (const Work& work : works)
        {
            std::filesystem::remove_all(folder.file("libvt"));
            std::size_t tiles = 0;
            const double seconds = secondsOf([&]() { tiles = work.run(); });
            rates[work.name].push_back(double(tiles) / seconds);
        }
    }
    std::printf("%zu tiles of %zu bytes, median and range of %d interleaved rounds, tiles/s\n",
                keys.size(), TileBytes, Rounds);
    for (const Work& work : works)
    {
        std::vector<double>& rate = rates[work.name];
        std::sort(rate.begin(), rate.end());
        std::printf("%-36s %9.0f  (%.0f - %.0f)\n", work.name.c_str(), rate[rate.size() / 2],
                    rate.front(), rate.back());
    }
    return EXIT_SUCCESS;
}
