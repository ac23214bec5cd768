// SPDX-License-Identifier: MIT
// Layouts of 100,000 photographs, and with OSGKITS_LONG of a million. The times are printed, not
// tested: an algorithm that compares all pairs would not end before the suite's limit.
#include "UpdateSamples.h"

#include <osgPagedTexture/AtlasChanges.h>

#include <support/ResidentMemory.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

/// Of the processor.
double secondsOf(const std::function<void()>& work)
{
    const std::clock_t start = std::clock();
    work();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

std::size_t manyPhotos()
{
    return std::getenv("OSGKITS_LONG") ? 1000000 : 100000;
}

std::vector<AtlasPhoto> photosOf(std::size_t count, bool wild)
{
    std::mt19937 random(1);
    std::vector<AtlasPhoto> photos(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        photos[i].path =
            "folder" + std::to_string(i / 1000) + "/photo" + std::to_string(i) + ".jpg";
        photos[i].width = wild && i % 2 ? 1 + int(random() % 20) : 2000 + int(random() % 4000);
        photos[i].height = wild && i % 3 ? 1 + int(random() % 20) : 2000 + int(random() % 4000);
        photos[i].hash = "0123456789abcdef0123456789abcdef";
    }
    return photos;
}

TEST(AtlasScale, manyPhotographsArePlaced)
{
    const std::size_t count = manyPhotos();
    AtlasLayout layout;
    const double packing = secondsOf([&] { layout = packAtlas(photosOf(count, false)); });
    const double adding = secondsOf([&] { addPhotos(layout, photosOf(1000, false)); });
    const double checking = secondsOf([&] { checkAtlas(layout); });
    const support::TemporaryFolder folder;
    const double writing = secondsOf([&] { writeAtlasLayout(folder.file("l.json"), layout); });
    const std::string hash = layout.getContentHash();
    const double reading = secondsOf([&] { layout = readAtlasLayout(folder.file("l.json")); });
    EXPECT_EQ(layout.getContentHash(), hash);
    EXPECT_GT(layout.getOccupiedShare(), 0.93); // beyond a million 0.98
    std::printf(
        "%zu photographs, %lld x %lld pixels, %.1f %% occupied: packed %.2f s, 1,000 added "
        "%.2f s, checked %.2f s, written %.2f s (%.0f MiB), read %.2f s; %.0f MiB of memory\n",
        count, static_cast<long long>(layout.width), static_cast<long long>(layout.height),
        100.0 * layout.getOccupiedShare(), packing, adding, checking, writing,
        double(fs::file_size(folder.file("l.json"))) / (1 << 20), reading, support::residentMiB());
}

TEST(AtlasScale, wildSizesArePlaced)
{
    const std::size_t count = manyPhotos();
    AtlasLayout layout;
    const double packing = secondsOf([&] { layout = packAtlas(photosOf(count, true)); });
    const double checking = secondsOf([&] { checkAtlas(layout); });
    std::printf("wild sizes: %.1f %% occupied, packed %.2f s, checked %.2f s\n",
                100.0 * layout.getOccupiedShare(), packing, checking);
    EXPECT_EQ(layout.photos.size(), count);
}

void writeFile(const std::string& path, unsigned int seed)
{
    std::ofstream file(path, std::ios::binary);
    file << "P6\n80 80\n255\n";
    std::mt19937 random(seed);
    std::string bytes(80 * 80 * 3, '\0');
    std::generate(bytes.begin(), bytes.end(), [&] { return char(random() % 200); });
    file << bytes;
}

/// 100,000 pieces of 8 x 8 pixels of 1,000 files, on more than 100,000 tiles.
TEST(AtlasScale, anUpdateOfOneOfManyTouchesItsPart)
{
    const support::TemporaryFolder folder;
    std::vector<AtlasPhoto> pieces;
    for (unsigned int i = 0; i < 1000; ++i)
    {
        const std::string name = std::to_string(i) + ".ppm";
        writeFile(folder.file(name), i);
        AtlasPhoto photo = describePhoto(folder.getPath().string(), name);
        for (int piece = 0; piece < 100; ++piece)
        {
            photo.used.assign(1, {8 * (piece % 10), 8 * (piece / 10), 8, 8});
            pieces.push_back(photo);
        }
    }
    AtlasSettings settings;
    settings.padding = 1;
    settings.alignment = 1;
    const AtlasLayout layout = packAtlas(pieces, settings);
    writeAtlasLayout(folder.file("many.layout.json"), layout);
    TileStoreOrigin origin;
    origin.settings.tileSide = 12;
    origin.settings.border = 2;
    origin.layout = "many.layout.json";
    origin.layoutHash = layout.getContentHash();
    const std::string store = folder.file("many.tiles");
    const double building = secondsOf([&] { buildTileStore(store, layout, origin, {}); });
    const auto tiles = TilePackReader(store).getInfo();
    writeFile(folder.file("500.ppm"), 7000);
    TileUpdateReport report;
    const double updating = secondsOf([&] { report = updateTileStore(store); });
    std::printf("%llu tiles built in %.2f s; one of 1,000 files updated in %.2f s, %llu tiles\n",
                static_cast<unsigned long long>(tiles.encodedTiles + tiles.uniformTiles), building,
                updating, static_cast<unsigned long long>(report.touchedTiles));
    EXPECT_EQ(report.changed, 1u);
    EXPECT_EQ(report.rebuilt, "");
    EXPECT_GT(tiles.encodedTiles, 100000u);
    EXPECT_LT(report.touchedTiles, 3000u);
}

} // namespace
