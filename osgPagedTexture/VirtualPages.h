// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileGrid.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace osgPagedTexture
{

/// A tile of a virtual texture, as its tile store counts: level 0 is the full size, x from the
/// left, y from the TOP. A texel (s, t) of level 0, from the top left corner of the atlas, is at
/// (s, t) / 2^level of a level, also where a level's size was rounded up; its page is that over
/// the payload, rounded down.
struct PageKey
{
    std::uint32_t texture = 0;
    std::int32_t level = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;

    bool operator==(const PageKey& other) const
    {
        return texture == other.texture && level == other.level && x == other.x && y == other.y;
    }
    bool operator!=(const PageKey& other) const { return !(*this == other); }

    /// By texture, the coarsest level first.
    bool operator<(const PageKey& other) const
    {
        return texture != other.texture ? texture < other.texture
               : level != other.level   ? level > other.level
               : y != other.y           ? y < other.y
                                        : x < other.x;
    }

    /// The page that covers it, `levels` levels coarser.
    PageKey ancestor(int levels = 1) const
    {
        return {texture, level + levels, x >> levels, y >> levels};
    }
    TileKey tile() const { return {level, x, y}; }
};

/// A page as it was at one state of its store. The shown state of a texture is replaced by another
/// one at once.
struct PageVersion
{
    PageKey page;
    std::uint32_t generation = 0;

    bool operator==(const PageVersion& other) const
    {
        return page == other.page && generation == other.generation;
    }
};

/// A page that a view asks for, and on how many of its feedback pixels.
struct PageNeed
{
    PageKey page;
    std::uint32_t pixels = 1;
};

/// Where the content of a page is found in the physical texture: what a texel of the page table
/// holds, 8 bits of level above 24 bits of slot.
struct PageEntry
{
    static constexpr std::uint32_t Empty = 0xFFFFFFFFu; ///< Not even the coarsest page is there.
    static constexpr int MaxSlots = (1 << 24) - 1;

    static std::uint32_t pack(int slot, int level)
    {
        return (std::uint32_t(level) << 24) | std::uint32_t(slot);
    }
    static int slotOf(std::uint32_t entry) { return int(entry & 0xFFFFFFu); }
    static int levelOf(std::uint32_t entry) { return int(entry >> 24); } ///< 255 of Empty.
};

/// The levels of a store that are paged: down to the first one that is a single page.
OSGPAGEDTEXTURE_EXPORT int pageLevels(const TileGrid& grid);

/// Whether a page has any of these pixels of level 0, border included.
OSGPAGEDTEXTURE_EXPORT bool touches(const TileGrid& grid, const PageKey& page,
                                    const PixelRect& pixels);

/// What a feedback picture asks for: equal pages become one with the number of their pixels.
/// Sorted. Pixels may come in any order; in that of rows it is fast.
OSGPAGEDTEXTURE_EXPORT std::vector<PageNeed> countPages(const std::vector<PageKey>& pages);

} // namespace osgPagedTexture

template <> struct std::hash<osgPagedTexture::PageKey>
{
    std::size_t operator()(const osgPagedTexture::PageKey& key) const noexcept
    {
        std::uint64_t mixed = (std::uint64_t(std::uint32_t(key.x)) << 32) | std::uint32_t(key.y);
        mixed ^= (std::uint64_t(key.texture) << 5 | std::uint32_t(key.level)) * 0x9E3779B97F4A7C15u;
        mixed = (mixed ^ (mixed >> 31)) * 0xBF58476D1CE4E5B9u;
        return static_cast<std::size_t>(mixed ^ (mixed >> 29));
    }
};

template <> struct std::hash<osgPagedTexture::PageVersion>
{
    std::size_t operator()(const osgPagedTexture::PageVersion& key) const noexcept
    {
        return std::hash<osgPagedTexture::PageKey>()(key.page) ^
               std::size_t(key.generation) * 0x94D049BB133111EBu;
    }
};
