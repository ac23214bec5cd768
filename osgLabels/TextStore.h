// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/FreeSpace.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace osgLabels
{

/// Texts of glyph codes, packed bit by bit, equal ones once.
///
/// A stored text never changes its place until repack(). It is named by a row: the upper 26 bits
/// are its offset in units of 2^getShift() codes, the lower 6 its length; 63 stands for a text of
/// 63 codes and more, which starts with its length less one in LengthBits bits, padded to whole
/// codes. Row 0 is no text.
///
/// With advances given, behind the codes of a text of LeastSummed codes and more stand sums of
/// them, floats of 32 bits each: of the first 16 codes, of the first 32, and so on; the last one is
/// of all codes. Shorter texts have none: these would be half of their size.
class OSGLABELS_EXPORT TextStore
{
public:
    using Row = std::uint32_t;
    using Codes = std::vector<std::uint32_t>;

    static constexpr std::size_t MaxLength = 1024;
    static constexpr unsigned int MaxBits = 20; ///< Of a code.
    static constexpr std::uint32_t Escape = 63; ///< In the length bits of a row.
    static constexpr unsigned int LengthBits = 10;
    static constexpr std::size_t SumStep = 16;     ///< Codes from one sum to the next.
    static constexpr std::size_t LeastSummed = 32; ///< Length from which on texts have sums.

    using AdvanceOf = std::function<float(std::uint32_t code)>;

    /// Units of a text's space.
    struct Block
    {
        std::uint32_t offset = 0, size = 0;
    };
    /// Words of words().
    struct Words
    {
        std::size_t begin = 0, end = 0;
    };

    /// How far a code reaches; there must be no text yet. Codes of equal value always get the same.
    void setAdvances(AdvanceOf advanceOf) { _advanceOf = std::move(advanceOf); }

    static std::uint32_t hash(const std::uint32_t* codes, std::size_t length);

    /// Whether add() has a place for a text of `length` codes without repack().
    bool fits(std::size_t length) const;
    /// Codes need no more than this many bits in all; 2^32 is what a shader can address.
    static constexpr std::uint64_t CapacityBits = std::uint64_t(1) << 32;

    /// Counts one more use of a text of 1..MaxLength codes of at most getBits() bits, which is
    /// stored if it is new: then `written` is where. `hash` is that of the codes. fits() holds.
    Row add(const std::uint32_t* codes, std::size_t length, std::uint32_t hash, Words& written);
    /// Counts one use less. True if that was the last one: then the text is forgotten and `freed`
    /// is its space, to be handed to free() once nobody reads it any more.
    bool release(Row row, Block& freed);
    void free(const Block& block) { _free.give(block.offset, block.size); }

    std::size_t lengthOf(Row row) const;
    Codes codesOf(Row row) const;
    bool equals(Row row, const std::uint32_t* codes, std::size_t length) const;

    /// Packs all texts anew without holes, with `bits` a code and units of 2^`shift` codes, in the
    /// order in which they lie. Returns old and new rows, sorted.
    std::vector<std::pair<Row, Row>> repack(unsigned int bits, unsigned int shift);

    unsigned int getBits() const { return _bits; }
    unsigned int getShift() const { return _shift; }
    const std::vector<std::uint32_t>& words() const { return _words; }
    std::size_t getTextCount() const { return _used; }
    std::uint64_t getFreeCodes() const { return _free.getTotal() << _shift; }
    std::uint64_t getEndCodes() const { return std::uint64_t(_end) << _shift; }
    std::size_t getBytes() const; ///< Of main memory.

private:
    struct Entry
    {
        Row row = 0; ///< 0: the slot is empty.
        std::uint32_t uses = 0;
        std::uint32_t hash = 0;
    };

    unsigned int headOf(std::size_t length) const;
    std::size_t sumsOf(std::size_t length) const;
    std::size_t spaceOf(std::size_t length) const; ///< Codes with head and sums.
    std::uint32_t unitsOf(std::size_t length) const;
    std::uint64_t bitOf(Row row) const;
    Row write(std::uint32_t offset, const std::uint32_t* codes, std::size_t length,
              std::vector<std::uint32_t>& words) const;
    std::size_t slotOf(std::uint32_t hash) const
    {
        return static_cast<std::size_t>(std::uint64_t(hash) * _entries.size() >> 32);
    }
    void insert(const Entry& entry);
    void erase(std::size_t slot);
    void growEntries();

    AdvanceOf _advanceOf;
    unsigned int _bits = 1;
    unsigned int _shift = 0;
    std::uint32_t _end = 0; ///< First unit that was never used.
    std::vector<std::uint32_t> _words;
    FreeSpace _free;
    std::vector<Entry> _entries; ///< Open addressing, linear.
    std::size_t _used = 0;
};

} // namespace osgLabels
