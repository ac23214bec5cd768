// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockEncoder.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// A page's texels as the physical texture takes them. The first row is the TOP one of the page, as
/// y of pages and texels counts from the top.
using PageTexels = std::vector<std::uint8_t>;

struct PageFormat
{
    BlockFormat format = BlockFormat::BC1; ///< RGBA8, BC1, BC3 or BC7.
    int side = 0; ///< Texels of a slot: the tile's, rounded up to whole blocks.
    EncodeQuality quality = EncodeQuality::Normal;
    TileColor background{255, 255, 255, 255}; ///< Where the store has nothing.

    std::uint64_t bytes() const { return levelBytes(format, side, side); }
};

/// The format of pages of a store: BC1 where its tiles have no alpha, else BC7.
OSGPAGEDTEXTURE_EXPORT BlockFormat pageFormatOf(const TileStoreSettings& store);

/// Texels of a slot's side for pages of a store.
OSGPAGEDTEXTURE_EXPORT int pageSideOf(const TileGrid& grid, BlockFormat format);

/// Turns a tile into a page. Tiles that end with the picture repeat its edge up to the full side.
/// `name` is for messages. Throws TileStoreError::Kind::Damaged where the tile is no picture or has
/// another size than the grid says. Any thread.
OSGPAGEDTEXTURE_EXPORT PageTexels makePage(const TileData& tile, const TileGrid& grid,
                                           const TileKey& key, const PageFormat& format,
                                           const std::string& name);

} // namespace osgPagedTexture
