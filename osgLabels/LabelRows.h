// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace osgLabels
{

/// Identifier → row and style, in the layout in which shaders read them.
///
/// Dense: one word an identifier, from 0 on. Sparse: an open-addressing hash of 2^n slots of two
/// words, identifier (0: empty) and row. Dense as long as the largest identifier is under
/// 4 x identifiers + 4096: up to there it takes less memory than the hash. Goes back from sparse to
/// dense when the hash would have to grow and the rule holds again.
class OSGLABELS_EXPORT LabelRows
{
public:
    using Row = std::uint32_t;
    static constexpr std::size_t None = ~std::size_t(0);

    /// 0 for identifiers without one.
    Row getRow(std::uint32_t identifier) const;
    std::uint32_t getStyle(std::uint32_t identifier) const;

    /// Sets the row, returns its slot. `isMoved` becomes true where all slots have new places.
    std::size_t setRow(std::uint32_t identifier, Row row, bool& isMoved);
    std::size_t setStyle(std::uint32_t identifier, std::uint32_t style, bool& isMoved);

    /// Replaces all rows; `moves` is sorted by the old ones and has them all.
    void replace(const std::vector<std::pair<Row, Row>>& moves);

    bool isSparse() const { return _log2 != 0; }
    /// The slot of an identifier, None where it has none.
    std::size_t slotOf(std::uint32_t identifier) const;

    const std::vector<std::uint32_t>& words() const { return _words; }
    std::size_t wordsPerSlot() const { return isSparse() ? 2 : 1; }
    /// One a slot; empty as long as no style was set, shorter than the rows where they are dense.
    const std::vector<std::uint32_t>& styles() const { return _styles; }
    unsigned int getLog2() const { return _log2; }     ///< Of the slots; 0 where dense.
    unsigned int getProbes() const { return _probes; } ///< Slots that a search looks at, at most.
    std::size_t getCount() const { return _count; }    ///< Identifiers with a row or a style.
    std::size_t getBytes() const;                      ///< Of main memory.

private:
    bool isDenseEnough(std::uint32_t largest, std::size_t count) const;
    std::size_t makeSlot(std::uint32_t identifier, bool& isMoved);
    std::size_t insert(std::uint32_t identifier);
    void relay(bool sparse, std::size_t count);

    std::vector<std::uint32_t> _words;
    std::vector<std::uint32_t> _styles;
    std::size_t _count = 0;
    std::size_t _taken = 0; ///< Slots of the hash that are not empty.
    std::uint32_t _largest = 0;
    unsigned int _log2 = 0, _probes = 0;
};

} // namespace osgLabels
