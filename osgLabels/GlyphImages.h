// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphSet.h>

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// Where one image of a glyph lies in its layer. The place p in em, x from the left of the glyph's
/// cell, is at p * scale + offset in texels.
struct ImageRectangle
{
    int x = 0, y = 0, width = 0, height = 0; ///< Texels.
    float scale = 1.0f;                      ///< Texels an em.
    glm::vec2 offset{0.0f};
};

/// Makes the images of a glyph that coverage.glsl reads. Free of OSG and GL.
///
/// Small letters: "boxes", coverage averaged over squares as large as a pixel, so that one look-up
/// is a pixel's coverage. Levels go by the square root of 2 from 1/2 em to 1/22.6 em; the four
/// channels are squares turned by 0, 22.5, 45 and 67.5 degrees. Large letters: the distance to the
/// outline, positive inside, which stays sharp at any size.
class OSGLABELS_EXPORT GlyphImages
{
public:
    static constexpr int Levels = 8;
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
    const ImageRectangle& getDistance() const { return _distance; }

    /// How far around the cell and the line an image reaches, in em; it is empty from there on.
    float getMargin(int level) const;
    float getDistanceMargin() const { return _overhang + DistanceSpread; }

    /// Of one layer of boxes, 4 bytes a texel, and of distance, 1 byte a texel.
    int getBoxesWidth() const { return _boxesWidth; }
    int getBoxesHeight() const { return _boxesHeight; }
    std::size_t getBoxesBytes() const;
    std::size_t getDistanceBytes() const;

    /// The pixels of a glyph's boxes, and in the first texel its advance in units of 2^-24 em, most
    /// significant byte first, at most 255. `image`: 0 for the ink, 1 for the grown ink.
    std::vector<std::uint8_t> makeBoxes(std::uint32_t code, int image) const;
    std::vector<std::uint8_t> makeDistance(std::uint32_t code, int image) const;

    /// Share of the cell that the glyph's ink covers.
    float getMeanCoverage(std::uint32_t code, int image) const;

private:
    GlyphOutline getOutline(std::uint32_t code, int image) const;
    void place(std::vector<ImageRectangle>& levels);

    const std::shared_ptr<const GlyphSet> _glyphs;
    const float _outlineWidth;
    float _overhang = 0.0f;
    std::vector<ImageRectangle> _levels;
    ImageRectangle _distance;
    int _boxesWidth = 0, _boxesHeight = 0;
};

/// Side of the squares of a level in em.
OSGLABELS_EXPORT float getBoxSide(int level);

/// The outline with all that is within `width` of it, filled where the winding number is not 0.
OSGLABELS_EXPORT GlyphOutline grow(const GlyphOutline& outline, float width);

} // namespace osgLabels
