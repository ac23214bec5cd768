// SPDX-License-Identifier: MIT
#include <osgLabels/LabelRows.h>

#include <algorithm>

namespace osgLabels
{

namespace
{

/// That of labelTable.glsl.
std::uint32_t homeOf(std::uint32_t identifier, unsigned int log2)
{
    std::uint32_t h = identifier * 0x9E3779B1u;
    h = (h ^ h >> 15) * 0x85EBCA77u;
    return h >> (32 - log2);
}

template <typename Vector> void growTo(Vector& vector, std::size_t size)
{
    if (size > vector.capacity())
        vector.reserve(size + size / 8 + 1024);
    if (size > vector.size())
        vector.resize(size, 0);
}

} // namespace

bool LabelRows::isDenseEnough(std::uint32_t largest, std::size_t count) const
{
    return largest < 4 * std::uint64_t(count) + 4096;
}

std::size_t LabelRows::slotOf(std::uint32_t identifier) const
{
    if (!isSparse())
        return identifier < _words.size() ? identifier : None;
    const std::size_t mask = (std::size_t(1) << _log2) - 1;
    for (std::size_t slot = homeOf(identifier, _log2); _words[2 * slot]; slot = (slot + 1) & mask)
        if (_words[2 * slot] == identifier)
            return slot;
    return None;
}

LabelRows::Row LabelRows::getRow(std::uint32_t identifier) const
{
    const std::size_t slot = slotOf(identifier);
    if (slot == None)
        return 0;
    return isSparse() ? _words[2 * slot + 1] : _words[slot];
}

std::uint32_t LabelRows::getStyle(std::uint32_t identifier) const
{
    const std::size_t slot = slotOf(identifier);
    return slot < _styles.size() ? _styles[slot] : 0;
}

std::size_t LabelRows::insert(std::uint32_t identifier)
{
    const std::size_t mask = (std::size_t(1) << _log2) - 1;
    std::size_t slot = homeOf(identifier, _log2);
    unsigned int probes = 1;
    for (; _words[2 * slot]; slot = (slot + 1) & mask)
        ++probes;
    _words[2 * slot] = identifier;
    _probes = std::max(_probes, probes);
    ++_taken;
    return slot;
}

void LabelRows::relay(bool sparse, std::size_t count)
{
    LabelRows from;
    std::swap(from._words, _words);
    std::swap(from._styles, _styles);
    std::swap(from._log2, _log2);
    _probes = 0;
    _taken = 0;
    _largest = 0;
    const std::size_t stride = from.wordsPerSlot();
    if (sparse)
    {
        // At most 2/3 full with as many again to come, so that moving is rare.
        _log2 = 6;
        while ((std::size_t(1) << _log2) * 2 < count * 3)
            ++_log2;
        _words.assign(std::size_t(2) << _log2, 0);
        if (!from._styles.empty())
            _styles.assign(std::size_t(1) << _log2, 0);
    }
    for (std::size_t slot = 0; slot * stride < from._words.size(); ++slot)
    {
        const Row row = from._words[slot * stride + stride - 1];
        const std::uint32_t style = slot < from._styles.size() ? from._styles[slot] : 0;
        if (!row && !style)
            continue;
        const auto identifier =
            stride == 2 ? from._words[2 * slot] : static_cast<std::uint32_t>(slot);
        _largest = std::max(_largest, identifier);
        if (!sparse)
            growTo(_words, std::size_t(identifier) + 1);
        const std::size_t to = sparse ? insert(identifier) : identifier;
        _words[sparse ? 2 * to + 1 : to] = row;
        if (style)
        {
            growTo(_styles, to + 1);
            _styles[to] = style;
        }
    }
}

std::size_t LabelRows::makeSlot(std::uint32_t identifier, bool& isMoved)
{
    std::size_t slot = slotOf(identifier);
    if (slot != None)
        return slot;
    const std::uint32_t largest = std::max(_largest, identifier);
    if (!isSparse() && !isDenseEnough(largest, _count + 1))
    {
        relay(true, _count + 1);
        isMoved = true;
    }
    else if (isSparse() && (_taken + 1) * 10 > (std::size_t(7) << _log2))
    {
        // Slots of removed identifiers go now, so it need not become larger.
        relay(!isDenseEnough(largest, _count + 1), _count + 1 + _count / 4);
        isMoved = true;
    }
    _largest = std::max(_largest, identifier);
    if (isSparse())
        return insert(identifier);
    growTo(_words, std::size_t(identifier) + 1);
    return identifier;
}

std::size_t LabelRows::setRow(std::uint32_t identifier, Row row, bool& isMoved)
{
    const bool had = getRow(identifier) || getStyle(identifier);
    const bool has = row || getStyle(identifier);
    if (!had && !has)
        return None;
    const std::size_t slot = makeSlot(identifier, isMoved);
    _words[slot * wordsPerSlot() + wordsPerSlot() - 1] = row;
    _count += std::size_t(has) - std::size_t(had);
    return slot;
}

std::size_t LabelRows::setStyle(std::uint32_t identifier, std::uint32_t style, bool& isMoved)
{
    const bool had = getRow(identifier) || getStyle(identifier);
    const bool has = style || getRow(identifier);
    if (!style && !getStyle(identifier))
        return None;
    const std::size_t slot = makeSlot(identifier, isMoved);
    growTo(_styles, isSparse() ? std::size_t(1) << _log2 : slot + 1);
    _styles[slot] = style;
    _count += std::size_t(has) - std::size_t(had);
    return slot;
}

void LabelRows::replace(const std::vector<std::pair<Row, Row>>& moves)
{
    const std::size_t stride = wordsPerSlot();
    for (std::size_t i = stride - 1; i < _words.size(); i += stride)
        if (_words[i])
            _words[i] =
                std::lower_bound(moves.begin(), moves.end(), std::make_pair(_words[i], 0u))->second;
}

std::size_t LabelRows::getBytes() const
{
    return (_words.capacity() + _styles.capacity()) * sizeof(std::uint32_t);
}

} // namespace osgLabels
