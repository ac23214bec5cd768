// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasLayout.h>

#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/FileBytes.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/SourceIndex.h>

#include <filesystem>
#include <limits>

namespace osgPagedTexture
{

AtlasPhoto describePhoto(const std::string& folder, const std::string& path)
{
    const std::string file = (std::filesystem::path(folder) / path).string();
    const std::int64_t now = wallClock();
    const auto stamp = stampOf(file);
    // A photograph of any size has its place; how it is read is the builder's concern.
    ImageLimits any;
    any.maxPixels = any.maxBytes = std::numeric_limits<std::uint64_t>::max();
    const ImageInfo info = readImageInfo(file, any, false);
    const FileHash hash = hashFile(file);
    AtlasPhoto photo;
    photo.path = path;
    photo.width = info.width;
    photo.height = info.height;
    photo.bytes = hash.fileBytes;
    photo.hash = hash.content.text();
    // A file that is written twice within a step of the file system's clock keeps its time, so a
    // fresh time stands for nothing.
    constexpr std::int64_t settled = 2000000000;
    photo.modified = stamp && stamp->modified + settled < now ? stamp->modified : 0;
    return photo;
}

} // namespace osgPagedTexture
