// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualPages.h>

#include <algorithm>
#include <tuple>

namespace osgPagedTexture
{

bool PageKey::operator<(const PageKey& other) const
{
    return std::tie(texture, other.level, y, x) < std::tie(other.texture, level, other.y, other.x);
}

int pageLevels(const TileGrid& grid)
{
    int levels = 1;
    while (levels < grid.getLevels() && grid.getTileCount(levels - 1) > 1)
    {
        ++levels;
    }
    return levels;
}

bool touches(const TileGrid& grid, const PageKey& page, const PixelRect& pixels)
{
    const TileRange range = grid.getTouched(pixels, page.level);
    return page.x >= range.x && page.x <= range.lastX && page.y >= range.y && page.y <= range.lastY;
}

std::vector<PageNeed> countPages(std::vector<PageKey> pages)
{
    std::sort(pages.begin(), pages.end());
    std::vector<PageNeed> needs;
    for (const PageKey& page : pages)
    {
        if (needs.empty() || needs.back().page != page)
        {
            needs.push_back({page, 0});
        }
        ++needs.back().pixels;
    }
    return needs;
}

} // namespace osgPagedTexture
