// SPDX-License-Identifier: MIT
#include "TableMirror.h"

#include <cstring>
#include <stdexcept>

using osgLabels::TableBuffer;

namespace
{

/// What nobody has written: no row looks like it by chance, so reading it shows.
constexpr std::uint32_t garbage = 0xDEADBEEFu;

} // namespace

bool TableMirror::resize(TableBuffer buffer, std::size_t bytes, unsigned int)
{
    auto& words = buffers[static_cast<std::size_t>(buffer)];
    if (words.size() >= bytes / 4)
        return true;
    if (losesContent)
        words.clear();
    words.resize(bytes / 4, garbage);
    return !losesContent;
}

void TableMirror::write(TableBuffer buffer, std::size_t offset, const void* data, std::size_t bytes)
{
    auto& words = buffers[static_cast<std::size_t>(buffer)];
    if (offset % 4 || bytes % 4 || offset + bytes > words.size() * 4)
        throw std::out_of_range("write outside of the buffer");
    std::memcpy(words.data() + offset / 4, data, bytes);
    sent += bytes;
    ++calls;
}

std::uint32_t TableMirror::bitsAt(std::uint64_t at, unsigned int count) const
{
    const auto& words = buffers[0];
    std::uint32_t value = 0;
    for (unsigned int i = 0; i < count; ++i, ++at)
        value |= (words.at(at / 32) >> (at % 32) & 1u) << i;
    return value;
}

std::pair<std::size_t, std::uint32_t> TableMirror::find(std::uint32_t identifier) const
{
    const auto& words = buffers[1];
    if (!isSparse())
        return identifier < layout.rows
                   ? std::make_pair(std::size_t(identifier), words.at(identifier))
                   : std::make_pair(~std::size_t(0), 0u);
    std::uint32_t h = identifier * 0x9E3779B1u;
    h = (h ^ h >> 15) * 0x85EBCA77u;
    std::size_t slot = h >> (32 - layout.log2);
    for (unsigned int i = 0; i < layout.probes; ++i, slot = (slot + 1) % (1u << layout.log2))
        if (words.at(2 * slot) == identifier)
            return {slot, words.at(2 * slot + 1)};
    return {~std::size_t(0), 0};
}

TableMirror::Codes TableMirror::codesOf(std::uint32_t identifier) const
{
    const std::uint32_t row = find(identifier).second;
    std::uint64_t at = (std::uint64_t(row >> 6) << layout.shift) * layout.bits;
    std::size_t length = row & 63;
    if (length == 63)
    {
        length = bitsAt(at, 10) + 1;
        at += std::uint64_t((10 + layout.bits - 1) / layout.bits) * layout.bits;
    }
    Codes codes(length);
    for (auto& code : codes)
    {
        code = bitsAt(at, layout.bits);
        at += layout.bits;
    }
    return codes;
}

std::vector<float> TableMirror::sumsOf(std::uint32_t identifier) const
{
    const std::uint32_t row = find(identifier).second;
    const std::size_t length = codesOf(identifier).size();
    const std::size_t head = length < 63 ? 0 : (10 + layout.bits - 1) / layout.bits;
    std::uint64_t at = ((std::uint64_t(row >> 6) << layout.shift) + head + length) * layout.bits;
    std::vector<float> sums(length < 32 ? 0 : (length + 15) / 16);
    for (float& sum : sums)
    {
        const std::uint32_t word = bitsAt(at, 32);
        std::memcpy(&sum, &word, sizeof(sum));
        at += 32;
    }
    return sums;
}

std::uint32_t TableMirror::styleOf(std::uint32_t identifier) const
{
    const std::size_t slot = find(identifier).first;
    return slot < layout.styles ? buffers[2].at(slot) : 0;
}
