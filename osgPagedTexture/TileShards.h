// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileUpdate.h>

#include <string>

namespace osgPagedTexture
{

/// One of several processes that build a store together, on any machines that share a folder.
struct TileShard
{
    int index = 0; ///< 0 to count - 1.
    int count = 1; ///< 1 to 9999. More than the rows of tiles of level 3 do nothing.

    /// The packed store with this part's fine tiles; its keptPathOf() has the coarse pixels.
    OSGPAGEDTEXTURE_EXPORT std::string path(const std::string& storePath) const;
};

/// Builds a part of a store: the tiles of the finest levels of some rows. Needs nothing of the
/// other parts. Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT TileBuildReport buildTileShard(const std::string& storePath,
                                                      const TileShard& shard,
                                                      const AtlasLayout& layout,
                                                      const TileStoreOrigin& origin,
                                                      const TilePackWriter::Options& options);

/// Finds how many parts there are beside a store. Throws TileStoreError where there are none, or
/// some of several builds.
OSGPAGEDTEXTURE_EXPORT int countTileShards(const std::string& storePath);

struct TileMergeReport
{
    std::uint64_t encodedTiles = 0;
    std::uint64_t uniformTiles = 0;
};

/// Makes one store of all its parts, byte for byte that of a build in one process, and removes
/// them. Killed at any moment it leaves the former store, if any, or the whole one. Throws
/// TileStoreError, also where a part is missing or not of this layout.
OSGPAGEDTEXTURE_EXPORT TileMergeReport mergeTileShards(const std::string& storePath, int count,
                                                       const TilePackWriter::Options& options);

} // namespace osgPagedTexture
