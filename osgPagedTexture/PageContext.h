// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PageTable.h>
#include <osgPagedTexture/VirtualPager.h>

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <vector>

namespace osgPagedTexture
{

/// What one graphics context has in its physical texture and its page tables, and what it still has
/// to do. Orders are carried out in the order they came, so that after each of them the tables name
/// only what is there. Not for several threads at once.
class PageContext
{
public:
    /// Content of a slot; each upload has a serial number of its own.
    struct Content
    {
        PageVersion page;
        std::uint64_t serial = 0; ///< 0: nothing.
    };
    struct Upload
    {
        int slot = 0;
        Content content;
        std::shared_ptr<const PageTexels> texels;
        bool isShown = true; ///< Else it is in no table before its generation is shown.
        bool isRefresh = false;
    };
    struct Carried
    {
        int slot = 0;
        std::uint64_t serial = 0;
    };
    /// A texture's way to another state of its store.
    struct Switch
    {
        std::uint32_t texture = 0;
        std::uint32_t generation = 0;
        std::vector<Carried> carried; ///< Are the same in both states.
        std::vector<Upload> uploads;  ///< Replace old content in its slots.
    };

    explicit PageContext(int slots) : _shown(std::size_t(slots)), _expected(std::size_t(slots)) {}

    void addTexture(std::uint32_t texture, const TileGrid& grid, int finestAllowed);
    void removeTexture(std::uint32_t texture);

    /// Orders an upload, instead of one to the same slot that waits.
    void order(const Upload& upload);
    void order(Switch change);

    bool has(int slot, std::uint64_t serial) const { return serialOf(slot) == serial; }
    /// Whether it has that when all orders are carried out.
    bool expects(int slot, std::uint64_t serial) const
    {
        return _expected[std::size_t(slot)] == serial;
    }
    std::uint64_t getQueuedBytes() const { return _queuedBytes; }
    bool isIdle() const { return _orders.empty(); }

    /// Carries out orders of at most `maxBytes` of uploads, see VirtualPager::takeUploads().
    PageUploads take(std::uint64_t maxBytes);

private:
    struct Order
    {
        bool isSwitch = false;
        Upload upload;
        Switch change;
    };
    struct Shown
    {
        Content content;
        bool isMapped = false;
    };
    struct Table
    {
        PageTable table;
        std::uint32_t sentVersion = 0;
    };
    std::uint64_t serialOf(int slot) const { return _shown[std::size_t(slot)].content.serial; }
    void carryOut(const Upload& upload, PageUploads& uploads);
    void carryOut(const Switch& change, PageUploads& uploads);
    void setMapped(int slot, bool isMapped);
    void takePatches(PageUploads& uploads);

    std::vector<Shown> _shown;
    std::vector<std::uint64_t> _expected; ///< Serial numbers.
    std::map<std::uint32_t, Table> _tables;
    std::list<Order> _orders;
    std::map<int, std::list<Order>::iterator> _waiting; ///< Uploads by slot.
    std::uint64_t _queuedBytes = 0;
};

} // namespace osgPagedTexture
