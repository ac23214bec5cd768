// SPDX-License-Identifier: MIT
#pragma once

#include "PictureFiles.h"

#include <osgPagedTexture/TileUpdate.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

/// A folder of photographs and a store that was built from them.
class UpdateSample
{
public:
    explicit UpdateSample(std::size_t count, unsigned int seed = 1, const char* format = "jpg")
        : _format(format)
    {
        std::filesystem::create_directories(photo(""));
        std::mt19937 random(seed);
        for (std::size_t i = 0; i < count; ++i)
        {
            int width = 120 + int(random() % 200), height = width * 2 / 3;
            if (random() % 3 == 0)
            {
                std::swap(width, height);
            }
            writePhoto(nameOf(i), width, height, seed + unsigned(i));
        }
    }

    static std::string nameOf(std::size_t i) { return "photo" + std::to_string(i) + ".jpg"; }
    std::string photo(const std::string& name) const { return _folder.file("photos/" + name); }
    std::string store() const { return _folder.file("sample.tiles"); }
    std::string layoutFile() const { return store() + ".layout.json"; }
    osgPagedTexture::AtlasLayout layout() const
    {
        return osgPagedTexture::readAtlasLayout(layoutFile());
    }

    void writePhoto(const std::string& name, int width, int height, unsigned int seed) const
    {
        std::filesystem::create_directories(std::filesystem::path(photo(name)).parent_path());
        JpegOptions options;
        options.fullChroma = seed % 2 == 0;
        options.progressive = seed % 5 == 0;
        const std::string bytes =
            encodeJpeg(samplePicture(width, height, seed % 7 == 0 ? 1 : 3, seed), options);
        std::ofstream(photo(name), std::ios::binary) << bytes;
    }

    osgPagedTexture::TileStoreOrigin origin() const
    {
        osgPagedTexture::TileStoreOrigin origin;
        origin.settings.tileSide = 40;
        origin.settings.border = 4;
        origin.settings.threads = 2;
        origin.settings.format.compression = 1;
        origin.settings.format.coding =
            _format == "png" ? osgPagedTexture::TileCoding::Png : osgPagedTexture::TileCoding::Jpeg;
        origin.settings.lossless = _format == "lossless";
        origin.layout = "sample.tiles.layout.json";
        return origin;
    }

    void build() const
    {
        using namespace osgPagedTexture;
        const std::string folder = _folder.getPath().string();
        std::vector<std::string> paths;
        for (const std::string& path : findPhotos(folder + "/photos"))
        {
            paths.push_back("photos/" + path);
        }
        AtlasLayout layout =
            packAtlas(describePhotos(folder, paths).photos, AtlasSettings::forTiles(40, 4));
        layout.photoFolder = "photos";
        writeAtlasLayout(layoutFile(), layout);
        buildAt(store());
    }

    /// A full build from the layout as it is now.
    osgPagedTexture::TileBuildReport buildAt(const std::string& path) const
    {
        osgPagedTexture::TileStoreOrigin from = origin();
        const osgPagedTexture::AtlasLayout now = layout();
        from.layoutHash = now.getContentHash();
        osgPagedTexture::TilePackWriter::Options options;
        options.durable = false; // many are built
        return osgPagedTexture::buildTileStore(path, now, from, options);
    }

    /// Whether the store, compacted, has the bytes of a full build, and so have its coarse pixels.
    testing::AssertionResult equalsFullBuild() const
    {
        using namespace osgPagedTexture;
        const std::string full = _folder.file("full.tiles");
        buildAt(full);
        for (const std::string& path : {store(), keptPathOf(store())})
        {
            const std::string other = path == store() ? full : keptPathOf(full);
            if (!std::filesystem::exists(other))
            {
                continue;
            }
            TilePackWriter::Options options;
            options.durable = false;
            compactTilePack(path, options);
            compactTilePack(other, options);
            if (bytesOf(path) != bytesOf(other))
            {
                return testing::AssertionFailure() << path << ": " << difference(path, other);
            }
        }
        return testing::AssertionSuccess();
    }

    static std::string bytesOf(const std::string& path)
    {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

private:
    /// The first tiles that differ.
    static std::string difference(const std::string& a, const std::string& b)
    {
        using namespace osgPagedTexture;
        const TilePackReader one(a), two(b);
        const TileGrid& grid = two.getSettings().grid;
        std::string text = one.getSettings().grid == grid ? "" : "other grids; ";
        text += one.getSettings().description == two.getSettings().description
                    ? ""
                    : "other descriptions; ";
        int differing = 0;
        for (int level = 0; level < grid.getLevels(); ++level)
        {
            for (std::int64_t y = 0; y < grid.getRows(level); ++y)
            {
                for (std::int64_t x = 0; x < grid.getColumns(level); ++x)
                {
                    const TileKey key{level, x, y};
                    if (!(one.read(key) == two.read(key)) && ++differing <= 5)
                    {
                        text += "tile " + std::to_string(level) + " " + std::to_string(x) + " " +
                                std::to_string(y) + "; ";
                    }
                }
            }
        }
        return text + std::to_string(differing) + " tiles differ";
    }

    support::TemporaryFolder _folder;
    const std::string _format;
};
