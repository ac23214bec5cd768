// SPDX-License-Identifier: MIT
// What is needed, and how it comes into the physical texture.
#include <osgPagedTexture/VirtualPagerState.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

namespace
{

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
