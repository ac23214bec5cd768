// SPDX-License-Identifier: MIT
// What the workers are asked for, and what they answer.
#include <osgPagedTexture/VirtualPagerState.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

namespace
{

constexpr std::chrono::seconds RetryTime(2);
constexpr int MostNamedTiles = 8;        ///< Of a store, before one line stands for all the others.
constexpr std::uint64_t MostAsked = 256; ///< Pages; more would be out of date when they come.

} // namespace

void VirtualPager::State::ask(const PageVersion& page,
                              const std::shared_ptr<const TileReader>& store,
                              const std::string& name, double priority, const ContentHash& known)
{
    const auto asked = _asked.find(page);
    if (asked != _asked.end())
    {
        asked->second = _time;
        return;
    }
    const std::uint64_t cached = std::max(settings.cacheBytes / format.bytes(), MinCachePages);
    if (_asked.size() + _ready < std::min(cached / 2, MostAsked))
    {
        _loader.request({page, store, name, format, priority, known});
        _asked[page] = _time;
    }
}

void VirtualPager::State::cancel(const std::function<bool(const PageVersion&)>& isGone)
{
    for (auto asked = _asked.begin(); asked != _asked.end();)
    {
        if (!isGone(asked->first))
        {
            ++asked;
            continue;
        }
        _loader.cancel(asked->first);
        asked = _asked.erase(asked);
    }
}

void VirtualPager::State::takeResults()
{
    for (PageResult& result : _loader.poll())
    {
        const auto texture = textures.find(result.page.page.texture);
        if (_asked.erase(result.page) != 0 && texture != textures.end())
        {
            accept(std::move(result), texture->second);
        }
    }
}

void VirtualPager::State::accept(PageResult result, PagerTexture& texture)
{
    const bool isNext = texture.next && texture.next->generation == result.page.generation;
    if (!isNext && (texture.generation != result.page.generation || texture.isPaused))
    {
        return;
    }
    if (result.state == PageResult::State::Failed)
    {
        fail(result, texture);
        return;
    }
    _failed.erase(result.page);
    if (result.state == PageResult::State::Unchanged)
    {
        texture.next->unchanged.insert(result.page.page);
    }
    else if (isNext)
    {
        texture.next->gathered[result.page.page] = std::move(result.loaded);
    }
    else
    {
        _cache->put(result.page, result.loaded);
    }
}

void VirtualPager::State::fail(const PageResult& result, PagerTexture& texture)
{
    const auto [failure, isNew] = _failed.emplace(result.page, Failure());
    failure->second = {result.mayPass, Clock::now()};
    if (isNew && texture.namedTiles <= MostNamedTiles)
    {
        _messages.push_back(texture.namedTiles < MostNamedTiles
                                ? result.error
                                : "osgPagedTexture::VirtualPager: more tiles of '" + texture.path +
                                      "' cannot be read");
        ++texture.namedTiles;
    }
}

bool VirtualPager::State::hasFailed(const PageVersion& page) const
{
    const auto failure = _failed.find(page);
    return failure != _failed.end() &&
           (!failure->second.mayPass || Clock::now() - failure->second.when < RetryTime);
}

} // namespace osgPagedTexture
