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

/// Identifiers around the steps of the sizes of tables.
constexpr std::uint32_t awkward[] = {1, 255, 256, 65535, 65536, (1u << 24) + 1, 0x7fffffffu};
