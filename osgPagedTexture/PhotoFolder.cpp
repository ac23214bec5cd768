// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoFolder.h>

#include <osgPagedTexture/CoreTeam.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileStore.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

namespace
{

bool isPictureName(const fs::path& path)
{
    static const char* const endings[] = {".jpg", ".jpeg", ".jpe",  ".png", ".tif", ".tiff",
                                          ".ppm", ".pgm",  ".bmp",  ".tga", ".exr", ".hdr",
                                          ".gif", ".webp", ".jp2",  ".dpx", ".psd", ".sgi",
                                          ".rgb", ".pnm",  ".heic", ".avif"};
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

} // namespace

std::vector<std::string> findPhotos(const std::string& folder)
{
    std::vector<std::string> paths;
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    while (!error && entry != fs::recursive_directory_iterator())
    {
        const bool hidden = entry->path().filename().string().rfind('.', 0) == 0;
        std::error_code unknown; // a link to nowhere is not there
        if (hidden)
        {
            entry.disable_recursion_pending();
        }
        else if (isPictureName(entry->path()) && entry->is_regular_file(unknown))
        {
            paths.push_back(entry->path().lexically_relative(folder).generic_string());
        }
        entry.increment(error);
    }
    if (error)
    {
        throw TileStoreError(TileStoreError::Kind::Unreadable,
                             "osgPagedTexture::PhotoFolder: '" + folder + "' cannot be read: " +
                                 error.message() + "; name a folder of photographs");
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

DescribedPhotos describePhotos(const std::string& folder, const std::vector<std::string>& paths,
                               unsigned int threads,
                               const std::function<void(std::uint64_t, std::uint64_t)>& progress)
{
    constexpr std::size_t atATime = 64;
    std::vector<std::optional<AtlasPhoto>> photos(paths.size());
    std::vector<std::string> causes(paths.size());
    CoreTeam team(threads);
    for (std::size_t first = 0; first < paths.size(); first += atATime)
    {
        team.run(std::min(atATime, paths.size() - first),
                 [&](std::size_t part, unsigned int)
                 {
                     try
                     {
                         photos[first + part] = describePhoto(folder, paths[first + part]);
                     }
                     catch (const ImageError& error)
                     {
                         causes[first + part] = error.what();
                     }
                 });
        if (progress)
        {
            progress(std::min(first + atATime, paths.size()), paths.size());
        }
    }
    DescribedPhotos described;
    for (std::size_t i = 0; i < paths.size(); ++i)
    {
        if (photos[i])
        {
            described.photos.push_back(std::move(*photos[i]));
        }
        else
        {
            described.failures.push_back({paths[i], std::move(causes[i])});
        }
    }
    return described;
}

} // namespace osgPagedTexture
