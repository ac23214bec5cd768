// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/TileFolders.h>
#include <osgPagedTexture/TilePack.h>

#include <filesystem>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

namespace
{

/// A line where a tile's file is not a picture of the right size; else empty.
std::string checkTile(const TileReader& reader, const TileKey& key, const std::string& path)
{
    const std::string name = "'" + path + "': tile " + std::to_string(key.x) + ", " +
                             std::to_string(key.y) + " of level " + std::to_string(key.level);
    try
    {
        const TileData tile = reader.read(key);
        const PixelRect pixels = reader.getSettings().grid.getPixels(key);
        if (tile.kind == TileData::Kind::Encoded)
        {
            const Pixels decoded = decodeTile(tile.bytes, name);
            if (decoded.width != pixels.width || decoded.height != pixels.height)
            {
                return "osgPagedTexture::TileStore: " + name + " has another size than the grid";
            }
        }
    }
    catch (const TileStoreError& error)
    {
        return error.what();
    }
    return "";
}

std::vector<std::string> verifyFolders(const std::string& path, std::size_t maxProblems)
{
    const auto reader = openTileStore(path);
    const TileGrid& grid = reader->getSettings().grid;
    std::vector<std::string> problems;
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        for (std::int64_t y = 0; y < grid.getRows(level); ++y)
        {
            for (std::int64_t x = 0; x < grid.getColumns(level); ++x)
            {
                const std::string problem = checkTile(*reader, {level, x, y}, path);
                if (!problem.empty() && problems.size() < maxProblems)
                {
                    problems.push_back(problem);
                }
            }
        }
    }
    return problems;
}

} // namespace

std::unique_ptr<TileReader> openTileStore(const std::string& path)
{
    std::error_code error;
    if (fs::is_directory(path, error))
    {
        return std::make_unique<TileFolderReader>(path, FolderLayout::LibVT);
    }
    if (fs::path(path).extension() == ".dzi")
    {
        return std::make_unique<TileFolderReader>(path, FolderLayout::DeepZoom);
    }
    return std::make_unique<TilePackReader>(path);
}

std::vector<std::string> verifyTileStore(const std::string& path, std::size_t maxProblems)
{
    try
    {
        std::error_code error;
        if (fs::is_directory(path, error) || fs::path(path).extension() == ".dzi")
        {
            return verifyFolders(path, maxProblems);
        }
        return TilePackReader(path).verify(maxProblems);
    }
    catch (const TileStoreError& error)
    {
        return {error.what()};
    }
}

} // namespace osgPagedTexture
