// SPDX-License-Identifier: MIT
#include <osgLabels/TextStore.h>

#include <osgLabels/PackedBits.h>

#include <algorithm>
#include <cstring>

namespace osgLabels
{

namespace
{

constexpr std::uint32_t units = 1u << 26; // that a row can name

} // namespace

std::uint32_t TextStore::hash(const std::uint32_t* codes, std::size_t length)
{
    std::uint64_t h = 0x9E3779B97F4A7C15u ^ length;
    for (std::size_t i = 0; i < length; ++i)
    {
        h = (h ^ codes[i]) * 0xD6E8FEB86659FD93u;
        h ^= h >> 32;
    }
    h *= 0xD6E8FEB86659FD93u;
    return static_cast<std::uint32_t>(h >> 32);
}

unsigned int TextStore::headOf(std::size_t length) const
{
    return length < Escape ? 0 : (LengthBits + _bits - 1) / _bits;
}

std::size_t TextStore::sumsOf(std::size_t length) const
{
    return _advanceOf && length >= LeastSummed ? (length + SumStep - 1) / SumStep : 0;
}

std::size_t TextStore::spaceOf(std::size_t length) const
{
    return headOf(length) + length + (32 * sumsOf(length) + _bits - 1) / _bits;
}

std::uint32_t TextStore::unitsOf(std::size_t length) const
{
    const std::size_t codes = spaceOf(length);
    return static_cast<std::uint32_t>((codes + (std::size_t(1) << _shift) - 1) >> _shift);
}

std::uint64_t TextStore::bitOf(Row row) const
{
    return (std::uint64_t(row >> 6) << _shift) * _bits;
}

bool TextStore::fits(std::size_t length) const
{
    // Holes may be too small, so only the untouched end is sure.
    const std::uint64_t end = std::uint64_t(_end) + unitsOf(length);
    return end <= units && (end << _shift) * _bits <= CapacityBits;
}

TextStore::Row TextStore::write(std::uint32_t offset, const std::uint32_t* codes,
                                std::size_t length, std::vector<std::uint32_t>& to) const
{
    const bool isLong = length >= Escape;
    const Row row = offset << 6 | (isLong ? Escape : static_cast<Row>(length));
    std::uint64_t at = bitOf(row);
    const std::uint64_t end = at + std::uint64_t(spaceOf(length)) * _bits;
    const auto size = static_cast<std::size_t>((end + 31) / 32);
    if (size > to.size())
    {
        // Doubling would waste half of what is the largest part of the table.
        if (size > to.capacity())
            to.reserve(size + size / 8 + 1024);
        to.resize(size, 0);
    }
    if (isLong)
        writeBits(to.data(), at, LengthBits, static_cast<std::uint32_t>(length - 1));
    at += std::uint64_t(headOf(length)) * _bits;
    for (std::size_t i = 0; i < length; ++i, at += _bits)
        writeBits(to.data(), at, _bits, codes[i]);
    double sum = 0.0;
    for (std::size_t i = 0; sumsOf(length) && i < length; ++i)
    {
        sum += double(_advanceOf(codes[i]));
        if ((i + 1) % SumStep && i + 1 < length)
            continue;
        const auto rounded = static_cast<float>(sum);
        std::uint32_t word = 0;
        std::memcpy(&word, &rounded, sizeof(word));
        writeBits(to.data(), at, 32, word);
        at += 32;
    }
    return row;
}

TextStore::Row TextStore::add(const std::uint32_t* codes, std::size_t length,
                              std::uint32_t hashOfCodes, Words& written)
{
    if (_used + 1 > _entries.size() / 5 * 4)
        growEntries();
    for (std::size_t slot = slotOf(hashOfCodes); _entries[slot].row;
         slot = slot + 1 == _entries.size() ? 0 : slot + 1)
    {
        Entry& entry = _entries[slot];
        if (entry.hash == hashOfCodes && equals(entry.row, codes, length))
        {
            ++entry.uses;
            written = {};
            return entry.row;
        }
    }
    const std::uint32_t size = unitsOf(length);
    const auto hole = _free.take(size);
    const std::uint32_t offset = hole ? *hole : _end;
    if (!hole)
        _end += size;
    const Row row = write(offset, codes, length, _words);
    const std::uint64_t bit = bitOf(row);
    const std::uint64_t codesWritten = spaceOf(length);
    written = {static_cast<std::size_t>(bit / 32),
               static_cast<std::size_t>((bit + codesWritten * _bits + 31) / 32)};
    insert({row, 1, hashOfCodes});
    ++_used;
    return row;
}

bool TextStore::release(Row row, Block& freed)
{
    const Codes codes = codesOf(row);
    std::size_t slot = slotOf(hash(codes.data(), codes.size()));
    while (_entries[slot].row != row)
        slot = slot + 1 == _entries.size() ? 0 : slot + 1;
    if (--_entries[slot].uses)
        return false;
    erase(slot);
    --_used;
    freed = {row >> 6, unitsOf(codes.size())};
    return true;
}

std::size_t TextStore::lengthOf(Row row) const
{
    const Row length = row & 63;
    return length == Escape ? readBits(_words.data(), bitOf(row), LengthBits) + 1 : length;
}

TextStore::Codes TextStore::codesOf(Row row) const
{
    Codes codes(lengthOf(row));
    std::uint64_t at = bitOf(row) + std::uint64_t(headOf(codes.size())) * _bits;
    for (std::uint32_t& code : codes)
    {
        code = readBits(_words.data(), at, _bits);
        at += _bits;
    }
    return codes;
}

bool TextStore::equals(Row row, const std::uint32_t* codes, std::size_t length) const
{
    if (!row || lengthOf(row) != length)
        return row == 0 && length == 0;
    std::uint64_t at = bitOf(row) + std::uint64_t(headOf(length)) * _bits;
    for (std::size_t i = 0; i < length; ++i, at += _bits)
        if (readBits(_words.data(), at, _bits) != codes[i])
            return false;
    return true;
}

std::vector<std::pair<TextStore::Row, TextStore::Row>> TextStore::repack(unsigned int bits,
                                                                         unsigned int shift)
{
    // The row is the upper bits' order: sorted rows are texts in the order in which they lie.
    std::vector<std::pair<Row, Entry*>> texts;
    texts.reserve(_used);
    for (Entry& entry : _entries)
        if (entry.row)
            texts.emplace_back(entry.row, &entry);
    std::sort(texts.begin(), texts.end());

    std::vector<std::pair<Row, Row>> moves;
    moves.reserve(texts.size());
    TextStore packed;
    packed._advanceOf = _advanceOf;
    packed._bits = bits;
    packed._shift = shift;
    packed._words.reserve(_words.size() / _bits * bits + 1);
    for (const auto& [row, entry] : texts)
    {
        const Codes codes = codesOf(row);
        entry->row = packed.write(packed._end, codes.data(), codes.size(), packed._words);
        packed._end += packed.unitsOf(codes.size());
        moves.emplace_back(row, entry->row);
    }
    _bits = bits;
    _shift = shift;
    _end = packed._end;
    _words = std::move(packed._words);
    _free.clear();
    return moves;
}

void TextStore::insert(const Entry& entry)
{
    std::size_t slot = slotOf(entry.hash);
    while (_entries[slot].row)
        slot = slot + 1 == _entries.size() ? 0 : slot + 1;
    _entries[slot] = entry;
}

void TextStore::erase(std::size_t slot)
{
    // Entries behind the gap that a search would no longer reach move up.
    const std::size_t size = _entries.size();
    std::size_t gap = slot;
    for (std::size_t next = (gap + 1) % size; _entries[next].row; next = (next + 1) % size)
    {
        const std::size_t home = slotOf(_entries[next].hash);
        if ((next + size - home) % size < (next + size - gap) % size)
            continue;
        _entries[gap] = _entries[next];
        gap = next;
    }
    _entries[gap] = {};
}

void TextStore::growEntries()
{
    std::vector<Entry> entries(std::max<std::size_t>(16, _entries.size() / 2 * 3));
    entries.swap(_entries);
    for (const Entry& entry : entries)
        if (entry.row)
            insert(entry);
}

std::size_t TextStore::getBytes() const
{
    constexpr std::size_t node = 48; // of a tree, as common standard libraries make them
    return _words.capacity() * sizeof(std::uint32_t) + _entries.capacity() * sizeof(Entry) +
           2 * node * _free.getCount();
}

} // namespace osgLabels
