// SPDX-License-Identifier: MIT
// Updates of a store of 62 photographs against a full build: one photograph changed, several, all;
// and the large picture in 1, 4, 16 and 64 parts, all of them or those that one photograph is in.
//
//   TileUpdateBenchmark [side [rounds]]   side of the atlas in pixels, 6144 or more, default 8192
//
// Wall and processor time, medians of interleaved rounds; every update is followed by a full build
// of the same layout.
#include "PictureFiles.h"

#include <osgPagedTexture/AtlasPicture.h>
#include <osgPagedTexture/TileUpdate.h>

#include <support/TemporaryFolder.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

constexpr int Photographs = 62;

struct Time
{
    double wall = 0.0;
    double processor = 0.0;
    double tiles = 0.0;
};

Time timeOf(const std::function<std::uint64_t()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    Time time;
    time.tiles = double(work());
    time.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    time.processor = double(std::clock() - processor) / CLOCKS_PER_SEC;
    return time;
}

double median(std::vector<Time>& times, double Time::*member)
{
    std::sort(times.begin(), times.end(),
              [&](const Time& a, const Time& b) { return a.*member < b.*member; });
    return times[times.size() / 2].*member;
}

class Store
{
public:
    explicit Store(int side)
    {
        fs::create_directories(_folder.file("photos"));
        // 3 : 2 pictures that fill nine tenths of the atlas.
        _height = int(std::sqrt(0.9 * side * side / Photographs / 1.5));
        _width = _height * 3 / 2;
        for (int i = 0; i < 3; ++i)
        {
            _pictures.push_back(samplePicture(_width, _height, 3, unsigned(i) + 1));
        }
        std::vector<std::string> paths;
        for (int i = 0; i < Photographs; ++i)
        {
            change(i, {0, 0, _width, _height}, i % 3);
            // Times of long ago are trusted, as they are when photographs are edited.
            fs::last_write_time(_folder.file(name(i)),
                                fs::file_time_type::clock::now() - std::chrono::hours(1));
            paths.push_back(name(i));
        }
        _layout = packAtlas(describePhotos(_folder.getPath().string(), paths).photos,
                            AtlasSettings::forTiles(256, 8));
        writeAtlasLayout(layoutPath(), _layout);
        _origin.layout = "bench.layout.json";
        _origin.settings.border = 8;
    }
    static std::string name(int photo) { return "photos/" + std::to_string(photo) + ".jpg"; }
    std::string layoutPath() const { return _folder.file("bench.layout.json"); }
    std::string path() const { return _folder.file("bench.tiles"); }
    const AtlasLayout& getLayout() const { return _layout; }

    /// Writes a photograph again with a part of another picture, from its top left corner.
    void change(int photo, const PixelRect& part, int picture)
    {
        Pixels pixels = _pictures[std::size_t(photo % 3)];
        const Pixels& other = _pictures[std::size_t(picture % 3)];
        for (std::int64_t y = 0; y < part.height; ++y)
        {
            const int row = _height - 1 - int(part.y + y);
            std::copy_n(other.row(row) + part.x * 3, part.width * 3, pixels.row(row) + part.x * 3);
        }
        std::ofstream(_folder.file(name(photo)), std::ios::binary) << encodeJpeg(pixels);
    }
    void changeAll(int photo, int picture) { change(photo, {0, 0, _width, _height}, picture); }

    std::uint64_t build()
    {
        _layout = readAtlasLayout(layoutPath());
        _origin.layoutHash = _layout.getContentHash();
        return buildTileStore(path(), _layout, _origin, {}).encodedTiles;
    }

    TileUpdateReport update(double rebuildShare = 1e9)
    {
        TileUpdateSettings settings;
        settings.rebuildShare = rebuildShare;
        return updateTileStore(path(), settings);
    }

    /// The large picture in squares, `side` in a row; those that hold anything of `changed`.
    std::uint64_t writeParts(int side, const PixelRect& changed)
    {
        AtlasPictureSettings settings;
        settings.path = _folder.file("atlas.tif");
        settings.partSide = (std::max(_layout.width, _layout.height) + side - 1) / side;
        return writeAtlas(_layout, _folder.getPath().string(), settings, changed).files.size();
    }

private:
    support::TemporaryFolder _folder;
    int _width = 0, _height = 0;
    std::vector<Pixels> _pictures;
    AtlasLayout _layout;
    TileStoreOrigin _origin;
};

} // namespace

int main(int argc, char** argv)
{
    const int side = argc > 1 ? std::max(std::atoi(argv[1]), 6144) : 8192;
    const int rounds = argc > 2 ? std::max(std::atoi(argv[2]), 1) : 3;
    Store store(side);
    store.build();
    std::printf("atlas of %lld x %lld pixels, %d photographs, tiles of 256 with a border of 8\n",
                static_cast<long long>(store.getLayout().width),
                static_cast<long long>(store.getLayout().height), Photographs);
    std::map<std::string, std::vector<Time>> times;
    for (int round = 0; round < rounds; ++round)
    {
        const auto measure = [&](const std::string& what, const std::function<void()>& change)
        {
            change();
            times[what].push_back(timeOf([&] { return store.update().touchedTiles; }));
            times["full build"].push_back(timeOf([&] { return store.build(); }));
        };
        measure("nothing", [] {});
        measure("a region of 512 x 512",
                [&] {
                    store.change(20, {64, 64, 512, 512}, 1 + round % 2);
                });
        measure("one photograph", [&] { store.changeAll(30, 1 + round % 2); });
        measure("six photographs",
                [&]
                {
                    for (int i = 0; i < 6; ++i)
                    {
                        store.changeAll(10 * i, i + 1 + round % 2);
                    }
                });
        measure("all photographs, piece by piece",
                [&]
                {
                    for (int i = 0; i < Photographs; ++i)
                    {
                        store.changeAll(i, i + 1 + round % 2);
                    }
                });
    }
    const PixelRect all{0, 0, store.getLayout().width, store.getLayout().height};
    const PixelRect one = store.getLayout().photos[30].getPlace();
    for (int round = 0; round < rounds; ++round)
        for (const int partsInRow : {1, 2, 4, 8})
        {
            const std::string name = "atlas in " + std::to_string(partsInRow * partsInRow);
            times[name].push_back(timeOf([&] { return store.writeParts(partsInRow, all); }));
            times[name + ", one photograph"].push_back(
                timeOf([&] { return store.writeParts(partsInRow, one); }));
        }
    for (auto& [what, each] : times)
    {
        std::printf("%-32s %7.3f s wall, %7.3f s of processor, %7.0f tiles or parts\n",
                    what.c_str(), median(each, &Time::wall), median(each, &Time::processor),
                    median(each, &Time::tiles));
    }
    return 0;
}
