// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PageLoader.h>
#include <osgPagedTexture/VirtualPages.h>

#include <cstdint>
#include <functional>
#include <list>
#include <unordered_map>

namespace osgPagedTexture
{

/// Pages in memory, ready for upload, within a number of bytes: the one used longest ago goes
/// first. Not for several threads at once.
class OSGPAGEDTEXTURE_EXPORT PageCache
{
public:
    struct Statistics
    {
        std::uint64_t hits = 0; ///< Pages found that had been found before.
        std::uint64_t bytes = 0;
        std::size_t pages = 0;
    };

    explicit PageCache(std::uint64_t maxBytes) : _maxBytes(maxBytes) {}

    /// Null where it is not there. Counts as use.
    const LoadedPage* find(const PageVersion& page);

    /// The same without counting as use.
    const LoadedPage* look(const PageVersion& page) const;

    /// Takes a page in or another content of it. One that is larger than all of the room is not
    /// kept.
    void put(const PageVersion& page, const LoadedPage& loaded);

    void remove(PageVersion page);

    /// Gives each page another name, or removes it where `rename` returns false. What has
    /// the other name already goes.
    void renameAll(const std::function<bool(PageVersion& page)>& rename);

    const Statistics& getStatistics() const { return _statistics; }

private:
    struct Entry
    {
        PageVersion page;
        LoadedPage loaded;
        bool isUsed = false;
    };

    const std::uint64_t _maxBytes;
    std::list<Entry> _entries; ///< Last used first.
    std::unordered_map<PageVersion, std::list<Entry>::iterator> _byPage;
    Statistics _statistics;
};

} // namespace osgPagedTexture
