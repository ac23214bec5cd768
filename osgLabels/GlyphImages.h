// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphSet.h>

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// Where one level of a glyph's image lies. The place p in em, x from the left of the glyph's
/// cell, is at p * scale + offset in texels.
struct ImageRectangle
{
    int x = 0, y = 0, width = 0, height = 0; ///< Texels.
    float scale = 1.0f;                      ///< Texels an em.
    glm::vec2 offset{0.0f};
};

/// Makes the image of a glyph that coverage.glsl reads, RGBA of 8 bits. Free of OSG and GL.
///
/// For small letters, in levels that go by the square root of 2: coverage averaged over squares as
/// large as a pixel, so that one look-up is a pixel's coverage. R and G are of a square of
/// getBoxSide(level), upright and turned by 45 degrees, B and A of one of getBoxSide(level + 1).
/// For large letters: the distance to the outline, positive inside, which stays sharp at any size.
/// Its lower left, lower right, upper left and upper right quarter are in R, G, B and A.
class OSGLABELS_EXPORT GlyphImages
{
public:
    static constexpr int Levels = 7;
    static constexpr int DistanceTexels = 128;                     ///< An em.
    static constexpr float DistanceSpread = 4.0f / DistanceTexels; ///< em that 0 and 1 stand for.

    /// `outlineWidth` in em, 0 to 0.25: 0 for none; else each glyph has a second image, grown by
    /// it on all sides.
    GlyphImages(std::shared_ptr<const GlyphSet> glyphs, float outlineWidth);

    /// 1, or 2 with an outline.
    int getImagesPerGlyph() const { return _outlineWidth > 0.0f ? 2 : 1; }

    float getOutlineWidth() const { return _outlineWidth; }

    /// How far ink may reach over the sides of its cell, in em; beyond it is cut off.
    float getOverhang() const { return _overhang; }

    const std::vector<ImageRectangle>& getLevels() const { return _levels; }

    /// As if it were one image; a quarter's rectangle is in width and height.
    const ImageRectangle& getDistance() const { return _distance; }

    /// From a quarter's texels to those of the next, in the whole image.
    const glm::ivec2& getQuarterStep() const { return _quarterStep; }

    /// How far around the cell and the line an image reaches, in em; it is empty from there on.
    float getMargin(int level) const;
    float getDistanceMargin() const { return _overhang + DistanceSpread; }

    int getWidth() const { return _width; }
    int getHeight() const { return _height; }
    std::size_t getBytes() const;

    /// The image's rows from the bottom. Its first texel is the glyph's advance in units of 2^-24
    /// em, most significant byte first. `which`: 0 for the ink, 1 for the grown ink.
    std::vector<std::uint8_t> make(std::uint32_t code, int which) const;

    /// Share of the cell that the glyph's ink covers.
    float getMeanCoverage(std::uint32_t code, int which) const;

private:
    GlyphOutline getOutline(std::uint32_t code, int which) const;
    void place();
    void drawBoxes(const GlyphOutline& outline, std::vector<std::uint8_t>& pixels) const;
    void drawDistances(const GlyphOutline& outline, std::vector<std::uint8_t>& pixels) const;

    const std::shared_ptr<const GlyphSet> _glyphs;
    const float _outlineWidth;
    float _overhang = 0.0f;
    std::vector<ImageRectangle> _levels;
    ImageRectangle _distance;
    glm::ivec2 _quarterStep{0};
    int _width = 0, _height = 0;
};

/// Side of the squares of a level in em: 1/2 for level 0.
OSGLABELS_EXPORT float getBoxSide(int level);

/// The outline with all that is within `width` of it, filled where the winding number is not 0.
OSGLABELS_EXPORT GlyphOutline grow(const GlyphOutline& outline, float width);

} // namespace osgLabels
