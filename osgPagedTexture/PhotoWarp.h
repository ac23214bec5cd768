// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoCamera.h>
#include <osgPagedTexture/Pixels.h>

namespace osgPagedTexture
{

/// What the model shows of one photograph, seen by the camera of another: a layer of `width` x
/// `height` pixels, RGBA, that lies over the other one's picture; alpha 0 where there is nothing.
/// The photograph needs places; `pixels` is its picture. What lies behind is hidden.
OSGPAGEDTEXTURE_EXPORT Pixels warpPhoto(const Photo& photo, const Pixels& pixels,
                                        const PhotoCamera& camera, int width, int height);

} // namespace osgPagedTexture
