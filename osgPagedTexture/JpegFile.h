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

class JpegDecoder;

/// Reads the header of a JPEG of 1, 3 or 4 components. Throws ImageError.
void readJpegHeader(JpegDecoder& decoder, const std::string& name);

/// "is a damaged JPEG (cause); ...".
ImageError damagedJpeg(const std::string& name, const std::string& cause);

/// CMYK to RGB, of `inkless` files as Adobe stores it, 255 for no ink; others store the ink.
void convertCmyk(const std::uint8_t* source, int width, bool inkless, std::uint8_t* target);

/// Refuses what is larger than the limits or than `fileBytes` can hold. Throws ImageError.
void checkJpegSize(const JpegDecoder& decoder, std::uint64_t fileBytes, const std::string& name,
                   const ImageLimits& limits);

/// Fills `info` from the start of a JPEG file. Returns false where the header goes on past `head`,
/// which is shorter than the file. Throws ImageError.
bool readJpegInfo(const std::string& head, std::uint64_t fileBytes, const std::string& name,
                  const ImageLimits& limits, ImageInfo& info);

} // namespace osgPagedTexture
