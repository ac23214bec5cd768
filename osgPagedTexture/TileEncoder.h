// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileFormat.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <memory>
#include <string>

namespace osgPagedTexture
{

/// A tile that is to be encoded.
struct TileRows
{
    const std::uint8_t* const* rows = nullptr; ///< The top one first.
    int width = 0;
    int height = 0;
    int channels = 0; ///< 1 grey, 3 RGB, 4 RGBA.
};

/// Makes picture files of tiles, the same bytes for the same pixels. One thread each.
class TileEncoder
{
public:
    virtual ~TileEncoder() = default;
    /// Throws TileStoreError where the pixels cannot be encoded.
    virtual std::string encode(const TileRows& tile) = 0;
};

/// Whether all pixels are equal.
bool isUniform(const TileRows& tile);

/// A uniform tile where all its pixels are equal, else an encoded one.
TileData makeTile(const TileRows& tile, TileEncoder& encoder);

std::unique_ptr<TileEncoder> makeTileEncoder(const TileFormat& format);
std::unique_ptr<TileEncoder> makeJpegTileEncoder(int quality, ChromaSampling chroma);
std::unique_ptr<TileEncoder> makePngTileEncoder(int compression);

} // namespace osgPagedTexture
