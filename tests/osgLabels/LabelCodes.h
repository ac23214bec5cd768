// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelTable.h>

#include <cstdint>

/// `length` codes below `glyphs` that count up from `first`, so that each place has its own.
inline osgLabels::LabelTable::Codes sequence(std::size_t length, std::uint32_t first,
                                             std::uint32_t glyphs)
{
    osgLabels::LabelTable::Codes codes(length);
    for (std::size_t i = 0; i < length; ++i)
        codes[i] = (first + static_cast<std::uint32_t>(i)) % glyphs;
    return codes;
}

/// Different for each number, 20 codes over 63 glyphs.
inline osgLabels::LabelTable::Codes tag(std::uint32_t number)
{
    osgLabels::LabelTable::Codes codes(20);
    std::uint64_t mixed = number * 0x9E3779B97F4A7C15u;
    for (std::size_t i = 0; i < 5; ++i, number /= 63)
        codes[i] = number % 63;
    for (std::size_t i = 5; i < 20;
         ++i, mixed = mixed * 6364136223846793005u + 1442695040888963407u)
        codes[i] = static_cast<std::uint32_t>(mixed >> 40) % 63;
    return codes;
}

/// Identifiers around the steps of the sizes of tables.
constexpr std::uint32_t awkward[] = {1, 255, 256, 65535, 65536, (1u << 24) + 1, 0x7fffffffu};
