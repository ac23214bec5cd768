// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSurface.h>

#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Names for files that belong to photographs, without extension, relative to a folder of their
/// own; no two are equal, also where upper and lower case are the same. "wall" of a/wall.jpg;
/// "wall.jpg" where there is a wall.png, too; "a/wall.jpg" where there is a b/wall.jpg. Photographs
/// without a file are "photograph1" and on.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> namesOfPhotos(const std::vector<Photo>& photos);

} // namespace osgPagedTexture
