// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ImageFile.h>

#include <string>

namespace osgPagedTexture
{

inline bool isJpeg(const std::string& firstBytes)
{
    return firstBytes.compare(0, 2, "\xff\xd8") == 0;
}

/// Fills `info` from the start of a JPEG file. Returns false where the header goes on past `head`,
/// which is shorter than the file. Throws ImageError.
bool readJpegInfo(const std::string& head, std::uint64_t fileBytes, const std::string& name,
                  const ImageLimits& limits, ImageInfo& info);

} // namespace osgPagedTexture
