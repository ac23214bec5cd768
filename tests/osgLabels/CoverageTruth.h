// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphSet.h>
#include <osgLabels/InkSpans.h>

#include <glm/mat2x2.hpp>

#include <cstdint>
#include <vector>

/// What share of a pixel a line of letters covers, by 256 samples of the outlines.
class CoverageTruth
{
public:
    static constexpr int Samples = 256;

    explicit CoverageTruth(const osgLabels::GlyphSet& glyphs);

    /// `place` and `footprint` as coverage.glsl has them.
    float getCoverage(const std::vector<std::uint32_t>& codes, const glm::vec2& place,
                      const glm::mat2& footprint) const;

    bool isInk(const std::vector<std::uint32_t>& codes, const glm::vec2& place) const;

private:
    bool isInk(const std::vector<std::uint32_t>& codes, const glm::vec2& place, int index,
               float left) const;

    std::vector<osgLabels::InkSpans> _ink;
    std::vector<float> _advances;
    float _cell; ///< 0 in proportional text.
};
