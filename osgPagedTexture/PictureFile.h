// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/Pixels.h>

#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Writes a picture of 1, 3 or 4 channels, the format by the extension; `quality` 1 to 100 where
/// that is lossy. Takes the place of an older file at once, when it is complete. Creates folders on
/// the way. Throws ImageError, and TileStoreError where the file cannot be written.
OSGPAGEDTEXTURE_EXPORT void writePictureFile(const std::string& path, const Pixels& pixels,
                                             int quality = 95);

struct PictureLayer
{
    std::string name;
    Pixels pixels; ///< RGB or RGBA.
};

/// Writes layers of one size as the pages of a TIFF file, the first one being the lowest, as GIMP
/// and others open them. As writePictureFile() else.
OSGPAGEDTEXTURE_EXPORT void writeLayers(const std::string& path,
                                        const std::vector<PictureLayer>& layers);

} // namespace osgPagedTexture
