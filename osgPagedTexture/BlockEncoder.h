// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/Pixels.h>

#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// How much time the encoder takes for a better picture.
enum class EncodeQuality
{
    Fast,   ///< Endpoints along the principal axis; not for line art.
    Normal, ///< And one least-squares refinement: textures that are read while one flies.
    Fine,   ///< Two.
    Best    ///< Cluster fit for BC1 and BC3's colour, all p-bits for BC7: some 20 times as long.
};

/// Which vector instructions encode. All give the same bytes.
enum class Instructions
{
    Baseline, ///< What every processor of the architecture has: SSE2.
    Avx2,
    Avx512
};

/// The widest that the processor has and the library was built with.
OSGPAGEDTEXTURE_EXPORT Instructions bestInstructions();

/// The picture in memory as OpenGL takes it, block rows from the bottom on.
///
/// To a blocked format: blocks that reach beyond the picture repeat its last row and column. BC1 is
/// opaque, whatever alpha the pixels have, and never uses its transparent index. BC3 and BC7 fit no
/// colour to texels of alpha 0; BC7 (mode 6) keeps opaque blocks opaque. BC4 holds the first
/// channel, BC5 the first two. Grey is all three colours; pixels without alpha are opaque.
/// To a plain format: the channels that it has. One thread; empty for an empty picture.
OSGPAGEDTEXTURE_EXPORT std::vector<std::uint8_t>
encodeBlocks(const Pixels& pixels, BlockFormat format,
             EncodeQuality quality = EncodeQuality::Normal,
             Instructions instructions = bestInstructions());

/// The picture of `width` x `height` that encodeBlocks() has encoded, as OpenGL shows it: RGB of
/// BC1, RGBA of BC3 and BC7, one and two channels of BC4 and BC5, plain formats as they are. Of BC7
/// only mode 6 is known, other blocks are transparent black. Throws std::invalid_argument where
/// `bytes` has another size than such a picture.
OSGPAGEDTEXTURE_EXPORT Pixels decodeBlocks(const std::vector<std::uint8_t>& bytes,
                                           BlockFormat format, int width, int height);

} // namespace osgPagedTexture
