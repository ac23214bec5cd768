// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageSlots.h>

#include <algorithm>

namespace osgPagedTexture
{

PageSlots::PageSlots(int count) : _slots(std::size_t(std::clamp(count, 1, PageEntry::MaxSlots)))
{
    _free.reserve(_slots.size());
    for (int slot = getCount() - 1; slot >= 0; --slot)
    {
        _free.push_back(slot);
    }
}

int PageSlots::find(const PageVersion& page) const
{
    const auto found = _byPage.find(page);
    return found == _byPage.end() ? None : found->second;
}

void PageSlots::need(int slot, std::uint64_t time)
{
    _slots[std::size_t(slot)].needed = time;
    unlink(slot);
    link(slot);
}

int PageSlots::take(const PageVersion& page, std::uint64_t time)
{
    int slot = None;
    if (!_free.empty())
    {
        slot = _free.back();
        _free.pop_back();
    }
    else if (_first != None && _slots[std::size_t(_first)].needed < time)
    {
        slot = _first;
        unlink(slot);
        _byPage.erase(getPage(slot));
    }
    if (slot != None)
    {
        Slot& taken = _slots[std::size_t(slot)];
        taken.page = page;
        taken.needed = time;
        taken.used = true;
        _byPage[page] = slot;
        link(slot);
    }
    return slot;
}

int PageSlots::countRoom(std::uint64_t time) const
{
    int room = int(_free.size());
    for (int slot = _first; slot != None && _slots[std::size_t(slot)].needed < time;
         slot = _slots[std::size_t(slot)].after)
    {
        ++room;
    }
    return room;
}

void PageSlots::free(int slot)
{
    if (!isUsed(slot))
    {
        return;
    }
    unlink(slot);
    _byPage.erase(getPage(slot));
    _slots[std::size_t(slot)] = {};
    _free.push_back(slot);
}

void PageSlots::rename(int slot, const PageVersion& page)
{
    _byPage.erase(getPage(slot));
    _slots[std::size_t(slot)].page = page;
    _byPage[page] = slot;
}

void PageSlots::link(int slot)
{
    Slot& linked = _slots[std::size_t(slot)];
    linked.before = _last;
    linked.after = None;
    (_last == None ? _first : _slots[std::size_t(_last)].after) = slot;
    _last = slot;
}

void PageSlots::unlink(int slot)
{
    const Slot& linked = _slots[std::size_t(slot)];
    (linked.before == None ? _first : _slots[std::size_t(linked.before)].after) = linked.after;
    (linked.after == None ? _last : _slots[std::size_t(linked.after)].before) = linked.before;
}

} // namespace osgPagedTexture
