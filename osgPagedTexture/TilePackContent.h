// SPDX-License-Identifier: MIT
// What a reader of a packed store holds open.
#pragma once

#include <osgPagedTexture/PackIndex.h>
#include <osgPagedTexture/TilePack.h>

namespace osgPagedTexture
{

struct TilePackReader::Content
{
    explicit Content(const std::string& path);
    TileData tileOf(const PackEntry& entry) const;

    StoreFile file;
    FoundHead found;
    TileStoreSettings settings;
    PackIndex index;
};

/// "tile 3, 4 of level 0".
std::string nameOf(const TileKey& key);

} // namespace osgPagedTexture
