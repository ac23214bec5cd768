// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ImageFile.h>

#include <string>

namespace osgPagedTexture
{

/// readImageInfo() and readImageFile() for what OpenImageIO reads, all but JPEG: its reader takes a
/// damaged one for good.
ImageInfo readOiioInfo(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits,
                       bool lookAtAlpha);
DecodedImage readOiioFile(const std::string& path, std::uint64_t fileBytes,
                          const ReadSettings& settings);

} // namespace osgPagedTexture
