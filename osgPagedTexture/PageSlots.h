// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/VirtualPages.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// The places of a physical texture and the pages in them. Which place is given away is decided by
/// when its page was needed last. All calls take constant time. Not for several threads at once.
class OSGPAGEDTEXTURE_EXPORT PageSlots
{
public:
    static constexpr int None = -1;

    /// `count` of 1 to PageEntry::MaxSlots.
    explicit PageSlots(int count);

    int getCount() const { return int(_slots.size()); }
    int getUsedCount() const { return int(_byPage.size()); }

    /// The page's slot or None.
    int find(const PageVersion& page) const;

    /// The page of a slot that isUsed().
    const PageVersion& getPage(int slot) const { return _slots[std::size_t(slot)].page; }
    bool isUsed(int slot) const { return _slots[std::size_t(slot)].used; }

    /// The page is needed at this time; times never go back. Of pages needed at the same time the
    /// first one named goes first.
    void need(int slot, std::uint64_t time);

    /// A slot for a page that has none: a free one, else the one whose page was needed longest
    /// ago, which loses it. None where all are needed at `time`. The page counts as
    /// needed at `time`.
    int take(const PageVersion& page, std::uint64_t time);

    /// How many pages could take() slots now. In time that grows with what may go.
    int countRoom(std::uint64_t time) const;

    /// The slot has no page any more.
    void free(int slot);

    /// What is in the slot is now known as this page, which has no other slot.
    void rename(int slot, const PageVersion& page);

private:
    struct Slot
    {
        PageVersion page;
        std::uint64_t needed = 0;
        int before = None; ///< In the list of what may go, the longest unneeded one first.
        int after = None;
        bool used = false;
    };
    void link(int slot);
    void unlink(int slot);

    std::vector<Slot> _slots;
    std::unordered_map<PageVersion, int> _byPage;
    std::vector<int> _free;
    int _first = None;
    int _last = None;
};

} // namespace osgPagedTexture
