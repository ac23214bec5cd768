// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PackFormat.h>

#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// The index of a packed store, read page by page. Any thread.
class PackIndex
{
public:
    /// `file` must live as long. Nothing is read yet.
    PackIndex(const StoreFile& file, const PackHead& head);

    /// Throws TileStoreError where a page that it needs is damaged.
    std::optional<PackEntry> find(std::uint64_t key) const;

    /// Entry by entry in the order of keys, the last one of each key, tiles that were taken away
    /// too.
    class Walk
    {
    public:
        /// From the first entry that is not below `firstKey`, over segments from this one on.
        explicit Walk(const PackIndex& index, std::uint64_t firstKey = 0,
                      std::uint32_t firstSegment = 0);
        std::optional<PackEntry> next();

    private:
        struct Place
        {
            std::uint32_t segment;
            std::uint64_t page;
            std::uint32_t entry;
            std::shared_ptr<const PackPage> entries; ///< Null at the segment's end.
        };
        void load(Place& place) const;

        const PackIndex& _index;
        std::vector<Place> _places;
    };

private:
    std::shared_ptr<const PackPage> page(std::uint32_t segment, std::uint64_t number) const;
    /// The last page whose first entry is not above the key; 0 where there is none.
    std::uint64_t pageOf(std::uint32_t segment, std::uint64_t key) const;

    const StoreFile& _file;
    std::vector<PackSegment> _segments;
    mutable std::mutex _mutex;
    mutable std::unordered_map<std::uint64_t, std::shared_ptr<const PackPage>> _pages;
};

/// Of a page at this place of the file.
std::uint64_t pageChecksum(const PackPage& page, std::uint64_t place);

} // namespace osgPagedTexture
