// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualPages.h>

#include <algorithm>

namespace osgPagedTexture
{

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

std::vector<PageNeed> countPages(const std::vector<PageKey>& pages)
{
    // Neighbours mostly want the same page: runs are far fewer than pixels.
    std::vector<PageNeed> runs;
    for (const PageKey& page : pages)
    {
        if (runs.empty() || runs.back().page != page)
        {
            runs.push_back({page, 0});
        }
        ++runs.back().pixels;
    }
    std::sort(runs.begin(), runs.end(),
              [](const PageNeed& one, const PageNeed& other) { return one.page < other.page; });
    std::vector<PageNeed> needs;
    for (const PageNeed& run : runs)
    {
        if (needs.empty() || needs.back().page != run.page)
        {
            needs.push_back({run.page, 0});
        }
        needs.back().pixels += run.pixels;
    }
    return needs;
}

} // namespace osgPagedTexture
