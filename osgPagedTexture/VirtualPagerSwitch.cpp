// SPDX-License-Identifier: MIT
// How a texture goes to another state of its store: all at once.
#include <osgPagedTexture/VirtualPagerState.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

bool VirtualPager::State::isTouched(const NextState& next, const TileGrid& grid,
                                    const PageKey& page)
{
    const auto& regions = next.change.regions;
    return next.change.isAll ||
           std::any_of(regions.begin(), regions.end(),
                       [&](const PixelRect& region) { return touches(grid, page, region); });
}

void VirtualPager::State::takeChanges()
{
    for (StoreWatch::Change& change : watch.takeChanges())
    {
        const auto found = textures.find(change.id);
        if (found == textures.end())
        {
            continue;
        }
        std::optional<StoreWatch::Change>& last = found->second.change;
        if (last)
        {
            change.isAll = change.isAll || last->isAll;
            change.regions.insert(change.regions.end(), last->regions.begin(), last->regions.end());
        }
        last = std::move(change);
    }
    for (auto& [id, texture] : textures)
    {
        if (!texture.next && texture.change)
        {
            texture.next.emplace();
            texture.next->change = *std::exchange(texture.change, {});
            texture.next->generation = ++texture.lastGeneration;
            texture.namedTiles = 0;
        }
        texture.isPaused = texture.change || watch.isBusy(id);
    }
}

/// What is in view and may be another in the next state, the coarsest first.
std::vector<PageNeed> VirtualPager::State::pagesToGather(std::uint32_t id,
                                                         const PagerTexture& texture) const
{
    std::vector<PageNeed> pages{{{id, texture.coarsest, 0, 0}, 1}};
    for (const PageNeed& need : _selection.getPages())
    {
        if (need.page.texture == id && need.page.level < texture.coarsest &&
            isTouched(*texture.next, texture.grid, need.page))
        {
            pages.push_back(need);
        }
    }
    return pages;
}

void VirtualPager::State::gather(std::uint32_t id, PagerTexture& texture)
{
    const std::vector<PageNeed> pages = pagesToGather(id, texture);
    if (_failed.count({pages.front().page, texture.next->generation}) != 0)
    {
        abandon(id, texture);
        return;
    }
    Room room{_slots.countRoom(_time), pagesInPlace()};
    bool isDone = true;
    for (const PageNeed& need : pages)
    {
        isDone = gatherOne(texture, need, room) && isDone;
    }
    if (isDone || contexts.empty())
    {
        goOver(id, texture, pages);
    }
}

int VirtualPager::State::pagesInPlace() const
{
    return int(std::clamp<std::uint64_t>(settings.switchBytes / format.bytes(), 1,
                                         std::uint64_t(_slots.getCount())));
}

/// Whether nothing has to be waited for: the page is gathered, or the picture does not have it now
/// either, or there is no room for it.
bool VirtualPager::State::gatherOne(PagerTexture& texture, const PageNeed& need, Room& room)
{
    NextState& next = *texture.next;
    const PageVersion page{need.page, next.generation};
    const int oldSlot = _slots.find({need.page, texture.generation});
    const bool isShown = oldSlot != PageSlots::None;
    if (next.unchanged.count(need.page) != 0 || _slots.find(page) != PageSlots::None ||
        _failed.count(page) != 0)
    {
        return true;
    }
    const bool hasSlot = room.slots > 0;
    int& share = hasSlot ? room.slots : room.inPlace;
    if (share <= 0 || (!hasSlot && !isShown))
    {
        return true;
    }
    --share;
    const auto gathered = next.gathered.find(need.page);
    if (gathered == next.gathered.end())
    {
        ask(page, next.change.store, texture.path, need.pixels,
            isShown ? _held[std::size_t(oldSlot)].source : ContentHash());
        return !isShown;
    }
    if (!hasSlot)
    {
        return true;
    }
    if (queuedBytes() >= settings.queueBytes)
    {
        ++_ready;
        return !isShown;
    }
    place(page, gathered->second, false, isShown);
    _cache->put(page, gathered->second);
    next.gathered.erase(gathered);
    return true;
}

/// The new state cannot be shown: even its coarsest page is damaged.
void VirtualPager::State::abandon(std::uint32_t id, PagerTexture& texture)
{
    const std::uint32_t generation = texture.next->generation;
    forget([&](const PageVersion& page)
           { return page.page.texture == id && page.generation == generation; });
    texture.next.reset();
    _messages.push_back("osgPagedTexture::VirtualPager: the new content of '" + texture.path +
                        "' cannot be shown, what is shown stays; update the store again");
}

void VirtualPager::State::goOver(std::uint32_t id, PagerTexture& texture,
                                 const std::vector<PageNeed>& pages)
{
    PageContext::Switch change;
    change.texture = id;
    change.generation = texture.next->generation;
    change.uploads = replaceInPlace(texture, pages);
    change.carried = carryOver(id, texture);
    for (auto& [page, loaded] : texture.next->gathered)
    {
        _cache->put({page, change.generation}, loaded);
    }
    texture.store = texture.next->change.store;
    texture.generation = change.generation;
    texture.next.reset();
    forget([&](const PageVersion& page)
           { return page.page.texture == id && page.generation != change.generation; });
    // What was asked for may be answered by a comparison with what is gone now.
    cancel([&](const PageVersion& page) { return page.page.texture == id; });
    for (auto& [context, each] : contexts)
    {
        each.order(change);
    }
    ++_statistics.switches;
}

std::vector<PageContext::Upload>
VirtualPager::State::replaceInPlace(PagerTexture& texture, const std::vector<PageNeed>& pages)
{
    const NextState& next = *texture.next;
    std::vector<PageContext::Upload> uploads;
    for (const PageNeed& need : pages)
    {
        const PageVersion page{need.page, next.generation};
        const int slot = _slots.find({need.page, texture.generation});
        const auto gathered = next.gathered.find(need.page);
        if (slot == PageSlots::None || gathered == next.gathered.end() ||
            _slots.find(page) != PageSlots::None || int(uploads.size()) >= pagesInPlace())
        {
            continue;
        }
        _slots.rename(slot, page);
        _held[std::size_t(slot)] = {++_lastSerial, gathered->second.source};
        uploads.push_back({slot, {page, _lastSerial}, gathered->second.texels, true, true});
    }
    return uploads;
}

/// Takes what is the same in both states into the next one.
std::vector<PageContext::Carried> VirtualPager::State::carryOver(std::uint32_t id,
                                                                 PagerTexture& texture)
{
    const NextState& next = *texture.next;
    const auto isSame = [&](const PageKey& page)
    { return next.unchanged.count(page) != 0 || !isTouched(next, texture.grid, page); };
    std::vector<PageContext::Carried> carried;
    for (int slot = 0; slot < _slots.getCount(); ++slot)
    {
        PageVersion page = _slots.getPage(slot);
        if (!_slots.isUsed(slot) || page.page.texture != id ||
            page.generation != texture.generation || !isSame(page.page))
        {
            continue;
        }
        page.generation = next.generation;
        _slots.rename(slot, page);
        carried.push_back({slot, _held[std::size_t(slot)].serial});
    }
    _cache->renameAll(
        [&](PageVersion& page)
        {
            const bool isOld = page.page.texture == id && page.generation == texture.generation;
            if (isOld && isSame(page.page))
            {
                page.generation = next.generation;
            }
            return true;
        });
    return carried;
}

/// Takes pages out of slots, cache and the list of failures.
void VirtualPager::State::forget(const std::function<bool(const PageVersion&)>& isGone)
{
    for (int slot = 0; slot < _slots.getCount(); ++slot)
    {
        if (_slots.isUsed(slot) && isGone(_slots.getPage(slot)))
        {
            _slots.free(slot);
        }
    }
    _cache->renameAll([&](const PageVersion& page) { return !isGone(page); });
    for (auto failed = _failed.begin(); failed != _failed.end();)
    {
        failed = isGone(failed->first) ? _failed.erase(failed) : std::next(failed);
    }
}

} // namespace osgPagedTexture
