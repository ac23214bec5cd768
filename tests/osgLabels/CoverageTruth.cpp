// SPDX-License-Identifier: MIT
#include "CoverageTruth.h"

#include <cmath>

namespace
{

/// Of the outlines' rows: a sixteenth of a pixel at 256 pixels an em.
constexpr int RowsPerEm = 4096;

} // namespace

CoverageTruth::CoverageTruth(const osgLabels::GlyphSet& glyphs)
    : _cell(glyphs.getSpacing() == osgLabels::Spacing::Cells ? glyphs.getCellAdvance() : 0.0f)
{
    for (std::uint32_t code = 0; code < glyphs.getSize(); ++code)
    {
        _ink.emplace_back(glyphs.getGlyph(code)->outline, RowsPerEm);
        _advances.push_back(glyphs.getGlyph(code)->advance);
    }
}

bool CoverageTruth::isInk(const std::vector<std::uint32_t>& codes, const glm::vec2& place,
                          int index, float left) const
{
    return index >= 0 && index < static_cast<int>(codes.size()) &&
           _ink[codes[static_cast<std::size_t>(index)]].contains(place.x - left, place.y);
}

bool CoverageTruth::isInk(const std::vector<std::uint32_t>& codes, const glm::vec2& place) const
{
    int index = 0;
    float left = 0.0f;
    if (_cell > 0.0f)
    {
        index = static_cast<int>(std::floor(place.x / _cell));
        left = static_cast<float>(index) * _cell;
    }
    else
        while (index < static_cast<int>(codes.size()) &&
               place.x >= left + _advances[codes[static_cast<std::size_t>(index)]])
            left += _advances[codes[static_cast<std::size_t>(index++)]];
    const auto getAdvance = [&](int i)
    {
        const bool isInside = i >= 0 && i < static_cast<int>(codes.size());
        return _cell > 0.0f ? _cell
               : isInside   ? _advances[codes[static_cast<std::size_t>(i)]]
                            : 0.0f;
    };
    return isInk(codes, place, index, left) ||
           isInk(codes, place, index - 1, left - getAdvance(index - 1)) ||
           isInk(codes, place, index + 1, left + getAdvance(index));
}

float CoverageTruth::getCoverage(const std::vector<std::uint32_t>& codes, const glm::vec2& place,
                                 const glm::mat2& footprint) const
{
    int hits = 0;
    for (int i = 0; i < Samples; ++i)
    {
        // A lattice of the golden ratio: 256 different rows and columns, where a grid has but 16.
        const double turns = (i + 0.5) * 0.6180339887498949;
        const glm::vec2 corner(static_cast<float>((i + 0.5) / Samples - 0.5),
                               static_cast<float>(turns - std::floor(turns) - 0.5));
        hits += isInk(codes, place + footprint * corner);
    }
    return static_cast<float>(hits) / Samples;
}
