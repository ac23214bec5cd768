// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace osgLabels
{

/// The lowest `count` (1..32) bits of the 32-bit words from bit `at` on, lowest bit first.
inline std::uint32_t readBits(const std::uint32_t* words, std::uint64_t at, unsigned int count)
{
    const std::uint32_t* word = words + at / 32;
    const auto shift = static_cast<unsigned int>(at % 32);
    std::uint64_t bits = word[0];
    if (shift + count > 32)
        bits |= std::uint64_t(word[1]) << 32;
    return static_cast<std::uint32_t>((bits >> shift) & ((std::uint64_t(1) << count) - 1));
}

/// Writes what readBits() reads; the bits around stay.
inline void writeBits(std::uint32_t* words, std::uint64_t at, unsigned int count,
                      std::uint32_t value)
{
    std::uint32_t* word = words + at / 32;
    const auto shift = static_cast<unsigned int>(at % 32);
    const std::uint64_t mask = ((std::uint64_t(1) << count) - 1) << shift;
    const std::uint64_t bits = std::uint64_t(value) << shift & mask;
    word[0] = static_cast<std::uint32_t>((word[0] & ~mask) | bits);
    if (shift + count > 32)
        word[1] = static_cast<std::uint32_t>((word[1] & ~(mask >> 32)) | bits >> 32);
}

/// Bits that hold all numbers from 0 to `largest`; at least 1.
inline unsigned int bitsFor(std::uint32_t largest)
{
    unsigned int bits = 1;
    while (bits < 32 && largest >> bits)
        ++bits;
    return bits;
}

} // namespace osgLabels
