// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/Pixels.h>

#include <string>

namespace osgPagedTexture
{

/// The orientation, 1 to 8, in the data of a JPEG's APP1 segment ("Exif\0\0" first); 1 where there
/// is none or where it makes no sense.
int exifOrientation(const std::string& segment);

/// How stored rows, the top one first, lie in Pixels, whose first row is the bottom of the picture
/// as shown.
struct Placement
{
    int width = 0; ///< As shown.
    int height = 0;
    std::ptrdiff_t offset = 0;    ///< Of the first stored pixel, in pixels.
    std::ptrdiff_t pixelStep = 1; ///< To the next pixel of a stored row.
    std::ptrdiff_t rowStep = 0;   ///< To the next stored row.
};

OSGPAGEDTEXTURE_EXPORT Placement placementOf(int storedWidth, int storedHeight, int orientation);

inline bool isTransposed(int orientation)
{
    return orientation >= 5 && orientation <= 8;
}

/// Copies stored row `y` to where it is shown.
OSGPAGEDTEXTURE_EXPORT void placeRow(const std::uint8_t* row, int storedWidth, int y,
                                     const Placement& placement, Pixels& pixels);

} // namespace osgPagedTexture
