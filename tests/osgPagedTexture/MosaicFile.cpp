// SPDX-License-Identifier: MIT
#include "MosaicFile.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/PhotoFolder.h>
#include <osgPagedTexture/TileStore.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace osgPagedTexture;

namespace
{

constexpr int LeastSide = 1024;
constexpr std::size_t MostPhotos = 18;

/// Colour photographs that are large enough.
std::vector<Pixels> installedPhotos()
{
    std::vector<Pixels> photos;
    std::vector<std::string> seen; // the same picture lies there in many sizes
    for (const char* folder : {"/usr/share/wallpapers", "/usr/share/backgrounds"})
    {
        for (const std::string& path : std::filesystem::is_directory(folder)
                                           ? findPhotos(folder)
                                           : std::vector<std::string>())
        {
            const std::string name = path.substr(0, path.find('/'));
            const bool nested = path.find("contents") != std::string::npos;
            if (photos.size() == MostPhotos || path.find(".jpg") == std::string::npos ||
                (nested && std::count(seen.begin(), seen.end(), name)))
            {
                continue;
            }
            Pixels pixels = readImageFile(std::string(folder) + "/" + path).pixels;
            if (pixels.channels == 3 && std::min(pixels.width, pixels.height) >= LeastSide)
            {
                photos.push_back(std::move(pixels));
                seen.push_back(name);
            }
        }
    }
    return photos;
}

} // namespace

int writeMosaic(const std::string& path, int side, int cellSide)
{
    const std::vector<Pixels> photos = installedPhotos();
    if (photos.empty())
    {
        throw std::runtime_error("no photographs are installed below /usr/share/wallpapers or "
                                 "/usr/share/backgrounds");
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                               std::fclose);
    if (!file || std::fprintf(file.get(), "P6\n%d %d\n255\n", side, side) < 0)
    {
        throw std::runtime_error("'" + path + "' cannot be written");
    }
    std::vector<std::uint8_t> row(std::size_t(side) * 3);
    for (int y = 0; y < side; ++y)
    {
        for (int x = 0; x < side; ++x)
        {
            const int column = x / cellSide, line = y / cellSide;
            const int cell = line * ((side + cellSide - 1) / cellSide) + column;
            const Pixels& photo = photos[std::size_t(cell) % photos.size()];
            const int shift = cell / int(photos.size()) * 37;
            const int px = (x - column * cellSide + shift) % photo.width;
            const int py = (y - line * cellSide + shift) % photo.height;
            std::copy_n(photo.row(photo.height - 1 - py) + 3 * px, 3, &row[std::size_t(x) * 3]);
        }
        if (std::fwrite(row.data(), 1, row.size(), file.get()) != row.size())
        {
            throw std::runtime_error("'" + path + "' cannot be written to its end");
        }
    }
    return int(photos.size());
}
