// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockEncoder.h>
#include <osgPagedTexture/MipChain.h>

namespace osgPagedTexture
{

/// What texels mean, which decides how they are averaged.
enum class TexelUse
{
    Color,    ///< sRGB: light is averaged, weighted by alpha; grey too.
    Data,     ///< Numbers: averaged as they are.
    NormalMap ///< Directions, 0 to 255 for -1 to 1: averaged and made unit vectors again.
};

/// The format that holds what the pixels hold and no more: no alpha block without alpha below 255,
/// one channel for grey (a BC4 texture shows red alone: of GL_LUMINANCE use it needs a swizzle),
/// two for normal maps. `best`: BC7 instead of BC1 and BC3, for contexts that have it.
OSGPAGEDTEXTURE_EXPORT BlockFormat chooseFormat(const Pixels& pixels, TexelUse use, bool best);

/// One level further: sides halved and rounded down, each texel the mean over its area, that of odd
/// sides too.
OSGPAGEDTEXTURE_EXPORT Pixels halve(const Pixels& pixels, TexelUse use);

/// All levels from `firstLevel`, whose pixels are given, down to 1x1, encoded. The picture's level
/// 0 is `width` x `height`. Throws std::invalid_argument where the pixels have another size than
/// that level. One thread; any.
OSGPAGEDTEXTURE_EXPORT MipChain makeMipChain(Pixels pixels, int firstLevel, int width, int height,
                                             TexelUse use, BlockFormat format,
                                             EncodeQuality quality = EncodeQuality::Normal);

} // namespace osgPagedTexture
