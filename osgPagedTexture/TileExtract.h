// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// The pixels of an encoded tile: JPEG, or what OpenImageIO reads. `name` is for messages. Throws
/// TileStoreError::Kind::Damaged.
OSGPAGEDTEXTURE_EXPORT Pixels decodeTile(const std::string& bytes, const std::string& name);

struct ExtractSettings
{
    int channels = 3;                         ///< 1 red or grey, 3 RGB, 4 RGBA.
    TileColor background{255, 255, 255, 255}; ///< Where there is nothing.
};

/// Gives the rows of a region of a level, from the top. What lies outside the level is cut off.
/// Memory: a row of tiles as wide as the region. Throws TileStoreError, also for an empty region.
OSGPAGEDTEXTURE_EXPORT void readRegion(const TileReader& reader, int level, const PixelRect& region,
                                       const ExtractSettings& settings,
                                       const std::function<void(const std::uint8_t* row)>& sink);

/// Writes a region of a level as a picture, the format by the extension: png, tif, jpg, ppm or
/// another that OpenImageIO writes. Memory as readRegion(). Nothing is left where it fails.
OSGPAGEDTEXTURE_EXPORT void extractRegion(const TileReader& reader, int level,
                                          const PixelRect& region, const ExtractSettings& settings,
                                          const std::string& path);

/// Reads a store of any kind to its end and returns a line for each damage, at most `maxProblems`.
/// Of a packed store each byte is compared with its checksum; tiles that are files are decoded.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> verifyTileStore(const std::string& path,
                                                                std::size_t maxProblems = 100);

} // namespace osgPagedTexture
