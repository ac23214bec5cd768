// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphImages.h>

#include <glm/mat2x2.hpp>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// coverage.glsl on the CPU: what it is tested against, and for labels that no shader draws.
///
/// Holds the images of all glyphs that the set has when it is made.
class OSGLABELS_EXPORT GlyphCoverage
{
public:
    explicit GlyphCoverage(std::shared_ptr<const GlyphSet> glyphs, float outlineWidth = 0.0f);

    /// As osgLabels_coverage(): share of the pixel that the ink of a line of glyphs covers, 0 to 1.
    /// `place` in em, `footprint` in em a pixel, by columns. `which`: 1 for ink with its outline.
    float getInk(const std::vector<std::uint32_t>& codes, const glm::vec2& place,
                 const glm::mat2& footprint, int which = 0) const;

    /// As osgLabels_width(), in em.
    float getWidth(const std::vector<std::uint32_t>& codes) const;

    /// As the shader has it; GlyphAtlas::setLegibleSize().
    void setLegibleSize(float pixelsPerEm) { _legibleSize = pixelsPerEm; }

private:
    struct Cell;
    struct Sampling;

    float getAdvance(const std::vector<std::uint32_t>& codes, int index) const;
    Cell getCell(const std::vector<std::uint32_t>& codes, float x) const;
    Cell getNeighbour(const std::vector<std::uint32_t>& codes, const Cell& cell, int step) const;
    float getLetterInk(const std::vector<std::uint32_t>& codes, const Cell& cell, glm::vec2 place,
                       const Sampling& sampling, const glm::vec4& lookUp) const;
    glm::vec4 read(std::size_t image, const glm::vec2& texel) const;
    Sampling getSampling(float squared, float turn) const;
    static glm::vec4 getLookUp(const Sampling& sampling, float squared);

    const std::shared_ptr<const GlyphSet> _glyphs;
    const GlyphImages _images;
    std::vector<std::vector<std::uint8_t>> _pixels;
    std::vector<float> _advances;
    float _mean = 0.0f;
    float _legibleSize = 2.0f;
};

} // namespace osgLabels
