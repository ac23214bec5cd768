// SPDX-License-Identifier: MIT
// What the module for OpenImageIO does; see OiioModule.h.
#pragma once

#include <osgPagedTexture/OiioModule.h>

#include <string>

namespace osgPagedTexture::oiio
{

/// readImageInfo() and readImageFile() for what OpenImageIO reads, all but JPEG: its reader takes a
/// damaged one for good.
ImageInfo readInfo(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits,
                   bool lookAtAlpha);
DecodedImage readFile(const std::string& path, std::uint64_t fileBytes,
                      const ReadSettings& settings);

/// Null where the picture has to be read as a whole.
std::unique_ptr<PhotoRows> openRows(const std::string& path, std::uint64_t fileBytes,
                                    const PhotoRowsSettings& settings);

Pixels decodeTile(const std::string& bytes, const std::string& name);
std::unique_ptr<PictureWriter> openWriter(const std::string& path, int width, int height,
                                          int channels);

void writePicture(const std::string& path, const Pixels& pixels, int quality);
void writePages(const std::string& path, const std::vector<PictureLayer>& layers);

} // namespace osgPagedTexture::oiio
