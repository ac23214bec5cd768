// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockEncoder.h>
#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/TileStore.h>

#include <string>

namespace osgPagedTexture
{

enum class TileCoding
{
    Jpeg, ///< 8 bits, no alpha.
    Png,
    Bc1, ///< In .dds files, the top row of blocks first; no alpha.
    Bc3,
    Bc7
};

/// How many of a JPEG's texels have a colour of their own.
enum class ChromaSampling
{
    Full,   ///< All: 4:4:4.
    Half,   ///< One of two: 4:2:2.
    Quarter ///< One of four: 4:2:0.
};

/// How the pixels of a tile become the bytes of a file.
struct TileFormat
{
    TileCoding coding = TileCoding::Jpeg;
    int quality = 85; ///< Of JPEG, 1 to 100.
    ChromaSampling chroma = ChromaSampling::Quarter;
    int compression = 6; ///< Of PNG, 0 to 9; 0 and 1 are quick and for photographs nearly as small.
    EncodeQuality blocks = EncodeQuality::Normal; ///< Of BC1, BC3 and BC7.

    /// "jpg", "png", "dds".
    OSGPAGEDTEXTURE_EXPORT std::string extension() const;
    bool keepsAlpha() const { return coding != TileCoding::Jpeg && coding != TileCoding::Bc1; }
};

/// Makes files of tiles of one colour, for stores in which each tile is a file; `channels` as the
/// other tiles have. For one thread at a time.
OSGPAGEDTEXTURE_EXPORT UniformEncoder makeUniformEncoder(const TileFormat& format, int channels);

} // namespace osgPagedTexture
