// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstddef>
#include <cstdint>

namespace osgPagedTexture
{

/// Makes (columns + 1) / 2 texels of two rows of 1, 3 or 4 channels, each the mean of 2 x 2; of an
/// odd number of columns the last texel is the mean of 2. `linearLight`: averages light, not sRGB
/// code values. Colours are weighted by the fourth channel.
OSGPAGEDTEXTURE_EXPORT void halveRow(const std::uint8_t* upper, const std::uint8_t* lower,
                                     std::size_t columns, int channels, bool linearLight,
                                     std::uint8_t* half);

} // namespace osgPagedTexture
