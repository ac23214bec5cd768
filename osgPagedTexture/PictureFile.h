// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/Pixels.h>

#include <string>

namespace osgPagedTexture
{

/// Writes a picture of 1, 3 or 4 channels, the format by the extension; `quality` 1 to 100 where
/// that is lossy. Takes the place of an older file at once, when it is complete. Creates folders on
/// the way. Throws ImageError.
OSGPAGEDTEXTURE_EXPORT void writePictureFile(const std::string& path, const Pixels& pixels,
                                             int quality = 95);

} // namespace osgPagedTexture
