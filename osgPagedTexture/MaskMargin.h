// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

namespace osgPagedTexture
{

/// Grows what is 255 of a mask by `margin` pixels to all sides and corners; over the edges to the
/// other side where the photograph repeats. Time does not depend on the margin.
void growMask(Pixels& mask, int margin, bool repeatsX, bool repeatsY);

} // namespace osgPagedTexture
