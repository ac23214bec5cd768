// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PackIndex.h>

#include <osgPagedTexture/ContentHash.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t MaxCachedPages = 1024; // 4 MiB

bool keyBelow(const PackEntry& entry, std::uint64_t key)
{
    return entry.key < key;
}

} // namespace

std::uint64_t pageChecksum(const PackPage& page, std::uint64_t place)
{
    return checksum(&page.count, sizeof(page) - sizeof(page.checksum), place);
}

PackIndex::PackIndex(const StoreFile& file, const PackHead& head)
    : _file(file), _segments(head.segments, head.segments + head.segmentCount)
{
}

std::shared_ptr<const PackPage> PackIndex::page(std::uint32_t segment, std::uint64_t number) const
{
    const std::uint64_t place = _segments[segment].place + number * sizeof(PackPage);
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        const auto known = _pages.find(place);
        if (known != _pages.end())
        {
            return known->second;
        }
    }
    const auto page = std::make_shared<PackPage>();
    _file.read(page.get(), sizeof(PackPage), place);
    if (page->checksum != pageChecksum(*page, place) || page->count == 0 ||
        page->count > PackPage::Capacity)
    {
        throwDamaged(_file.getPath(),
                     "the index page at byte " + std::to_string(place) + " is damaged");
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_pages.size() >= MaxCachedPages)
    {
        _pages.clear(); // the few that every search meets are soon here again
    }
    _pages.emplace(place, page);
    return page;
}

std::uint64_t PackIndex::pageOf(std::uint32_t segment, std::uint64_t key) const
{
    std::uint64_t first = 0;
    for (std::uint64_t end = _segments[segment].pages; end - first > 1;)
    {
        const std::uint64_t middle = first + (end - first) / 2;
        if (page(segment, middle)->entries[0].key <= key)
        {
            first = middle;
        }
        else
        {
            end = middle;
        }
    }
    return first;
}

std::optional<PackEntry> PackIndex::find(std::uint64_t key) const
{
    for (std::uint32_t segment = static_cast<std::uint32_t>(_segments.size()); segment-- > 0;)
    {
        const auto entries = page(segment, pageOf(segment, key));
        const PackEntry* end = entries->entries + entries->count;
        const PackEntry* entry = std::lower_bound(entries->entries, end, key, keyBelow);
        if (entry != end && entry->key == key)
        {
            return entry->bytes == PackEntry::None ? std::nullopt : std::optional(*entry);
        }
    }
    return std::nullopt;
}

PackIndex::Walk::Walk(const PackIndex& index, std::uint64_t firstKey, std::uint32_t firstSegment)
    : _index(index)
{
    for (auto segment = firstSegment; segment < index._segments.size(); ++segment)
    {
        Place place{segment, index.pageOf(segment, firstKey), 0, nullptr};
        load(place);
        const PackEntry* begin = place.entries->entries;
        place.entry = static_cast<std::uint32_t>(
            std::lower_bound(begin, begin + place.entries->count, firstKey, keyBelow) - begin);
        load(place);
        _places.push_back(place);
    }
}

void PackIndex::Walk::load(Place& place) const
{
    if (place.entries && place.entry < place.entries->count)
    {
        return;
    }
    if (place.entries)
    {
        ++place.page;
        place.entry = 0;
    }
    place.entries = place.page < _index._segments[place.segment].pages
                        ? _index.page(place.segment, place.page)
                        : nullptr;
}

std::optional<PackEntry> PackIndex::Walk::next()
{
    const Place* best = nullptr;
    for (const Place& place : _places) // later segments come later: the last of equal keys counts
    {
        if (place.entries && (!best || place.entries->entries[place.entry].key <=
                                           best->entries->entries[best->entry].key))
        {
            best = &place;
        }
    }
    if (!best)
    {
        return std::nullopt;
    }
    const PackEntry entry = best->entries->entries[best->entry];
    for (Place& place : _places)
    {
        if (place.entries && place.entries->entries[place.entry].key == entry.key)
        {
            ++place.entry;
            load(place);
        }
    }
    return entry;
}

} // namespace osgPagedTexture
