// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgLabels
{

/// Key → index, of as many keys as it is made for: a hash table in one block of memory, which is
/// made anew in a frame without an allocation a key.
class KeyIndex
{
public:
    static constexpr std::uint32_t None = 0xFFFFFFFFu;

    explicit KeyIndex(std::size_t count)
    {
        std::size_t size = 4;
        while (size < 2 * count)
            size *= 2;
        _slots.resize(size);
    }

    /// A key that is there already keeps its index.
    void add(std::uint64_t key, std::uint32_t index)
    {
        Slot& slot = find(key);
        if (!slot.isUsed)
            slot = {key, index, true};
    }

    /// None for a key that is not there or was taken before.
    std::uint32_t take(std::uint64_t key)
    {
        Slot& slot = find(key);
        const std::uint32_t index = slot.index;
        slot.index = None;
        return index;
    }

private:
    struct Slot
    {
        std::uint64_t key = 0;
        std::uint32_t index = None;
        bool isUsed = false;
    };

    Slot& find(std::uint64_t key)
    {
        const std::size_t mask = _slots.size() - 1;
        std::size_t at = mixed(key) & mask;
        while (_slots[at].isUsed && _slots[at].key != key)
            at = (at + 1) & mask;
        return _slots[at];
    }

    /// The finalizer of Vigna's SplitMix64: neighbouring keys get distant places.
    static std::size_t mixed(std::uint64_t key)
    {
        key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9u;
        key = (key ^ (key >> 27)) * 0x94D049BB133111EBu;
        return static_cast<std::size_t>(key ^ (key >> 31));
    }

    std::vector<Slot> _slots;
};

} // namespace osgLabels
