// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/TileStore.h>

#include <osg/Image>

namespace osgPagedTexture
{

/// A tile store's whole picture, RGB, with sides of at most `longestSide`, at least 1: its texture
/// coordinates are those of the store's level 0. Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT osg::ref_ptr<osg::Image> readOverview(const TileReader& reader,
                                                             int longestSide);

} // namespace osgPagedTexture
