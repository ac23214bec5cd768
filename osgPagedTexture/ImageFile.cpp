// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ImageFile.h>

#include <osgPagedTexture/FileBytes.h>
#include <osgPagedTexture/JpegFile.h>
#include <osgPagedTexture/OiioModule.h>
#include <osgPagedTexture/PhotoRows.h>

namespace osgPagedTexture
{

ImageInfo readImageInfo(const std::string& path, const ImageLimits& limits, bool lookAtAlpha)
{
    // A JPEG's header lies within this but for giant profiles; then all of it is read.
    constexpr std::size_t headBytes = 64 << 10;
    const FileHead head = readFileHead(path, headBytes);
    ImageInfo info;
    if (readPnmInfo(head.bytes, head.fileBytes, path, limits, info))
    {
        return info;
    }
    if (!isJpeg(head.bytes))
    {
        return oiioFunctions().readInfo(path, head.fileBytes, limits, lookAtAlpha);
    }
    if (!readJpegInfo(head.bytes, head.fileBytes, path, limits, info))
    {
        const std::string all = readFileBytes(path);
        readJpegInfo(all, all.size(), path, limits, info);
    }
    return info;
}

DecodedImage readImageFile(const std::string& path, const ReadSettings& settings)
{
    constexpr std::size_t headBytes = 1024;
    const FileHead head = readFileHead(path, headBytes);
    if (isJpeg(head.bytes))
    {
        return readJpegBytes(readFileBytes(path), path, settings);
    }
    ImageInfo info;
    readPnmInfo(head.bytes, head.fileBytes, path, settings.limits, info); // refuses, see there
    return oiioFunctions().readFile(path, head.fileBytes, settings);
}

} // namespace osgPagedTexture
