// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageSelection.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

bool isBefore(const PageNeed& one, const PageNeed& other)
{
    if (one.page.level != other.page.level)
    {
        return one.page.level > other.page.level;
    }
    return one.pixels != other.pixels ? one.pixels > other.pixels : one.page < other.page;
}

} // namespace

void PageMemory::add(const std::vector<PageNeed>& needs)
{
    std::uint64_t pixels = 0;
    std::uint64_t fresh = 0;
    for (const PageNeed& need : needs)
    {
        pixels += need.pixels;
        fresh += _pages.count(need.page) ? 0 : need.pixels;
    }
    if (fresh * 2 > pixels)
    {
        _pages.clear();
    }
    ++_report;
    for (const PageNeed& need : needs)
    {
        // Single reports are noisy, so that a page's weight falls slowly.
        Remembered& page = _pages[need.page];
        page.pixels = std::max(need.pixels, page.pixels - page.pixels / 8);
        page.report = _report;
    }
    _needs.clear();
    for (auto page = _pages.begin(); page != _pages.end();)
    {
        if (page->second.report + std::uint64_t(_reports) <= _report)
        {
            page = _pages.erase(page);
            continue;
        }
        _needs.push_back({page->first, page->second.pixels});
        ++page;
    }
    std::sort(_needs.begin(), _needs.end(), isBefore);
}

std::size_t PageSelection::collect(const std::vector<PageNeed>& needs,
                                   const std::vector<int>& coarsest, int bias)
{
    std::vector<std::vector<PageKey>> byLevel;
    _closure.clear();
    const auto add = [&](const PageKey& page, std::uint32_t pixels)
    {
        const auto [place, isNew] = _closure.emplace(page, pixels);
        if (isNew)
        {
            byLevel.resize(std::max(byLevel.size(), std::size_t(page.level) + 1));
            byLevel[std::size_t(page.level)].push_back(page);
        }
        else
        {
            place->second += pixels;
        }
    };
    for (const PageNeed& need : needs)
    {
        const int last = coarsest[need.page.texture];
        add(need.page.ancestor(std::clamp(last - need.page.level, 0, bias)), need.pixels);
    }
    for (std::size_t level = 0; level < byLevel.size(); ++level)
    {
        for (std::size_t i = 0; i < byLevel[level].size(); ++i)
        {
            const PageKey page = byLevel[level][i];
            if (page.level < coarsest[page.texture])
            {
                add(page.ancestor(), _closure[page]);
            }
        }
    }
    _collected = bias;
    return _closure.size();
}

void PageSelection::choose(const std::vector<PageNeed>& needs, const std::vector<int>& coarsest,
                           int room)
{
    const int most = coarsest.empty() ? 0 : *std::max_element(coarsest.begin(), coarsest.end());
    _bias = std::min(_bias, most);
    const std::size_t limit = std::size_t(std::max(room, 0));
    _unbiased = collect(needs, coarsest, 0);
    std::size_t count = _bias == 0 ? _unbiased : collect(needs, coarsest, _bias);
    if (count > limit)
    {
        while (count > limit && _bias < most)
        {
            count = collect(needs, coarsest, ++_bias);
        }
    }
    else
    {
        const std::size_t spared = limit - (limit + 9) / 10;
        while (_bias > 0 &&
               (_bias == 1 ? _unbiased : collect(needs, coarsest, _bias - 1)) <= spared)
        {
            --_bias;
        }
        if (_bias != _collected)
        {
            collect(needs, coarsest, _bias);
        }
    }
    _pages.clear();
    for (const auto& [page, pixels] : _closure)
    {
        _pages.push_back({page, pixels});
    }
    std::sort(_pages.begin(), _pages.end(), isBefore);
    if (_pages.size() > limit)
    {
        std::stable_sort(_pages.begin(), _pages.end(),
                         [](const PageNeed& one, const PageNeed& other)
                         { return one.pixels > other.pixels; });
        _pages.resize(limit);
        std::sort(_pages.begin(), _pages.end(), isBefore);
    }
}

} // namespace osgPagedTexture
