// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstdint>
#include <string>

namespace osgPagedTexture
{

/// How the texels of a texture lie in memory: plain, or in blocks of 4x4.
enum class BlockFormat
{
    R8,
    RG8, ///< Grey and alpha, or two channels of data.
    RGB8,
    RGBA8,
    BC1, ///< DXT1, opaque colour, 8 bytes a block.
    BC3, ///< DXT5, colour and alpha, 16 bytes.
    BC4, ///< RGTC1, one channel, 8 bytes.
    BC5, ///< RGTC2, two channels, 16 bytes.
    BC7  ///< BPTC, colour with or without alpha, 16 bytes.
};

OSGPAGEDTEXTURE_EXPORT bool isBlocked(BlockFormat format);

/// Bytes of one texel of a plain format, of one 4x4 block of the others.
OSGPAGEDTEXTURE_EXPORT int unitBytes(BlockFormat format);

/// "BC1".
OSGPAGEDTEXTURE_EXPORT std::string formatName(BlockFormat format);

/// Texels of a side at a mip level: side / 2^level rounded down, at least 1.
OSGPAGEDTEXTURE_EXPORT int levelSide(int side, int level);

/// Mip levels of a full chain down to 1x1: 1 for a texture of one texel.
OSGPAGEDTEXTURE_EXPORT int levelCount(int width, int height);

/// Bytes of one level of `width` x `height` texels (that level's own size).
OSGPAGEDTEXTURE_EXPORT std::uint64_t levelBytes(BlockFormat format, int width, int height);

/// Bytes of all levels from `firstLevel` down to 1x1 of a texture whose level 0 is `width` x
/// `height`.
OSGPAGEDTEXTURE_EXPORT std::uint64_t chainBytes(BlockFormat format, int width, int height,
                                                int firstLevel);

} // namespace osgPagedTexture
