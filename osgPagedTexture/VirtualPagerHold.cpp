// SPDX-License-Identifier: MIT
// What is needed, and how it comes into the physical texture.
#include <osgPagedTexture/VirtualPagerState.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

namespace
{

constexpr double RetrySeconds = 2.0;
constexpr int MostNamedTiles = 8;        ///< Of a store, before one line stands for all the others.
constexpr std::uint64_t MostAsked = 256; ///< Pages; more would be out of date when they come.

double seconds(std::chrono::steady_clock::duration time)
{
    return std::chrono::duration<double>(time).count();
}

} // namespace

void VirtualPager::State::advance(unsigned int frame)
{
    if (frame == _frame)
    {
        return;
    }
    _frame = frame;
    ++_time;
    dropIdleContexts();
    if (textures.empty())
    {
        _isChanged = false;
        _selection.choose({}, {}, 0);
        count(0);
        return;
    }
    takeChanges();
    takeResults();
    choose();
    needHeld();
    _ready = 0;
    for (auto& [id, texture] : textures)
    {
        if (texture.next)
        {
            gather(id, texture);
        }
    }
    hold();
    cancel([&](const PageVersion& page) { return _asked.at(page) != _time; });
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
           (!failure->second.mayPass ||
            seconds(Clock::now() - failure->second.when) < RetrySeconds);
}

void VirtualPager::State::choose()
{
    if (!_isChanged || isFrozen)
    {
        return;
    }
    _isChanged = false;
    std::vector<int> coarsest(_lastTexture, 0);
    std::vector<PageNeed> needs;
    for (const auto& [id, texture] : textures)
    {
        coarsest[id] = texture.coarsest;
        needs.push_back({{id, texture.coarsest, 0, 0}, 0});
    }
    for (const auto& [view, memory] : views)
    {
        for (const PageNeed& need : memory.getNeeds())
        {
            if (textures.count(need.page.texture) != 0)
            {
                needs.push_back(need);
            }
        }
    }
    _selection.choose(needs, coarsest, _slots.getCount());
}

/// All that is to stay is named before anything is given a slot, the least important first.
void VirtualPager::State::needHeld()
{
    const std::vector<PageNeed>& pages = _selection.getPages();
    for (auto need = pages.rbegin(); need != pages.rend(); ++need)
    {
        const auto texture = textures.find(need->page.texture);
        if (texture == textures.end())
        {
            continue;
        }
        const std::uint32_t next =
            texture->second.next ? texture->second.next->generation : texture->second.generation;
        for (const std::uint32_t generation : {next, texture->second.generation})
        {
            const int slot = _slots.find({need->page, generation});
            if (slot != PageSlots::None)
            {
                _slots.need(slot, _time);
            }
        }
    }
}

void VirtualPager::State::hold()
{
    std::size_t missing = 0;
    for (const PageNeed& need : _selection.getPages())
    {
        const auto texture = textures.find(need.page.texture);
        missing += texture != textures.end() && !holdOne(need, texture->second);
    }
    count(missing);
}

/// Whether the page is there, or will not come.
bool VirtualPager::State::holdOne(const PageNeed& need, PagerTexture& texture)
{
    const PageVersion page{need.page, texture.generation};
    const int slot = _slots.find(page);
    if (slot != PageSlots::None && isExpected(slot))
    {
        return isEverywhere(slot);
    }
    if (hasFailed(page))
    {
        return true;
    }
    if (texture.isPaused || (texture.next && isTouched(*texture.next, texture.grid, need.page)))
    {
        return false; // what would come now is not of the state that is shown
    }
    const LoadedPage* loaded = _cache->look(page);
    if (!loaded)
    {
        ask(page, texture.store, texture.path, need.pixels, {});
        return false;
    }
    if (queuedBytes() >= settings.queueBytes || contexts.empty())
    {
        ++_ready;
        return false;
    }
    const LoadedPage taken = *_cache->find(page);
    if (slot == PageSlots::None)
    {
        place(page, taken, true, false);
    }
    else
    {
        deliver(slot, page, taken, true, false);
    }
    return false;
}

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

/// Gives a page a slot, None where there is none.
int VirtualPager::State::place(const PageVersion& page, const LoadedPage& loaded, bool isShown,
                               bool isRefresh)
{
    const int slot = _slots.take(page, _time);
    if (slot != PageSlots::None)
    {
        _held[std::size_t(slot)] = {++_lastSerial, loaded.source};
        deliver(slot, page, loaded, isShown, isRefresh);
    }
    return slot;
}

void VirtualPager::State::deliver(int slot, const PageVersion& page, const LoadedPage& loaded,
                                  bool isShown, bool isRefresh)
{
    const std::uint64_t serial = _held[std::size_t(slot)].serial;
    for (auto& [id, context] : contexts)
    {
        if (!context.expects(slot, serial))
        {
            context.order(
                PageContext::Upload{slot, {page, serial}, loaded.texels, isShown, isRefresh});
        }
    }
}

bool VirtualPager::State::isEverywhere(int slot) const
{
    return !contexts.empty() &&
           std::all_of(contexts.begin(), contexts.end(),
                       [&](const auto& context)
                       { return context.second.has(slot, _held[std::size_t(slot)].serial); });
}

bool VirtualPager::State::isExpected(int slot) const
{
    return std::all_of(contexts.begin(), contexts.end(),
                       [&](const auto& context)
                       { return context.second.expects(slot, _held[std::size_t(slot)].serial); });
}

std::uint64_t VirtualPager::State::queuedBytes() const
{
    std::uint64_t bytes = 0;
    for (const auto& [id, context] : contexts)
    {
        bytes = std::max(bytes, context.getQueuedBytes());
    }
    return bytes;
}

void VirtualPager::State::count(std::size_t missing)
{
    _statistics.missingPages = missing;
    if (missing > 0)
    {
        if (!_isUnsharp)
        {
            _isUnsharp = true;
            _unsharpSince = Clock::now();
            _unsharpFrames = 0;
        }
        ++_unsharpFrames;
    }
    else if (std::exchange(_isUnsharp, false))
    {
        _statistics.secondsUntilSharp = seconds(Clock::now() - _unsharpSince);
        _statistics.framesUntilSharp = _unsharpFrames;
    }
}

} // namespace osgPagedTexture
