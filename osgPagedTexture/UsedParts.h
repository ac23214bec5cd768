// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/Pixels.h>
#include <osgPagedTexture/TileGrid.h>

#include <vector>

namespace osgPagedTexture
{

/// Rectangles that hold all used pixels of a mask, in pixels from the picture's top left corner.
/// They do not overlap; pixels that touch each other are in one. Their sides lie on multiples of
/// `block`, or on the picture's edge, so that they can be cut out of a JPEG without loss. None for
/// a mask without used pixels.
OSGPAGEDTEXTURE_EXPORT std::vector<PixelRect> findUsedParts(const Pixels& mask, int block = 16);

/// The same as closely as blocks can: what a mask uses and nothing but the rest of its blocks, in
/// few rectangles.
OSGPAGEDTEXTURE_EXPORT std::vector<PixelRect> findUsedBlocks(const Pixels& mask, int block = 16);

} // namespace osgPagedTexture
