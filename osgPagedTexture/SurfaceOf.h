// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TexelNeed.h>

#include <osg/Geometry>

namespace osgPagedTexture
{

/// How a drawable lies under a texture unit; without a density where nothing can be said. Where it
/// has no texture coordinates for the unit those of unit 0 count, as shaders take them. Of what is
/// stretched 1 part in 256 by area does not count. Reads all triangles.
TexelSurface surfaceOf(const osg::Drawable& drawable, unsigned int unit);

} // namespace osgPagedTexture
