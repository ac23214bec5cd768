// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphImages.h>

#include <osgLabels/BoxSums.h>
#include <osgLabels/InkSpans.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osgLabels
{

namespace
{

constexpr int TexelsPerBox = 4;
/// Bilinear filtering widens what it reads; the squares are made narrower by half of that, which
/// leaves the least error. (The variance of a square of side w is w^2/12, of the filter 1/6 texel.)
constexpr float Narrowing = 0.9682f;
constexpr int Turns = 4;
constexpr int CellsPerEm = 512;
/// Texels between images, so that filtering one never reads its neighbour.
constexpr int Gap = 1;

GlyphOutline turn(GlyphOutline outline, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    for (std::vector<glm::vec2>& contour : outline.contours)
        for (glm::vec2& point : contour)
            point = {c * point.x + s * point.y, c * point.y - s * point.x};
    return outline;
}

ImageRectangle makeRectangle(float cell, float margin, float texelsPerEm)
{
    ImageRectangle rectangle;
    const float border = std::ceil(margin * texelsPerEm);
    rectangle.scale = texelsPerEm;
    rectangle.offset = glm::vec2(border);
    rectangle.width = static_cast<int>(std::ceil(cell * texelsPerEm) + 2.0f * border);
    rectangle.height = static_cast<int>(std::ceil(texelsPerEm) + 2.0f * border);
    return rectangle;
}

void moveTo(ImageRectangle& rectangle, int x, int y)
{
    rectangle.x = x;
    rectangle.y = y;
    rectangle.offset += glm::vec2(x, y);
}

/// The texel's middle in em.
glm::vec2 getPlace(const ImageRectangle& rectangle, int x, int y)
{
    return (glm::vec2(rectangle.x + x, rectangle.y + y) + 0.5f - rectangle.offset) /
           rectangle.scale;
}

float getAsciiOverhang(const GlyphSet& glyphs)
{
    const FontFace& face = glyphs.getFace();
    float overhang = 0.0f;
    for (char32_t character = '!'; character <= '~'; ++character)
    {
        const std::uint32_t glyph = face.getGlyph(character);
        const OutlineBounds bounds = getBounds(face.getOutline(glyph));
        const float advance = face.getAdvance(glyph);
        const float cell =
            glyphs.getSpacing() == Spacing::Cells ? glyphs.getCellAdvance() : advance;
        const float shift = 0.5f * (cell - advance);
        overhang = std::max({overhang, -bounds.low.x - shift, bounds.high.x + shift - cell});
    }
    return overhang;
}

std::uint8_t toByte(float share)
{
    return static_cast<std::uint8_t>(std::lrint(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

} // namespace

float getBoxSide(int level)
{
    return std::exp2(-1.0f - 0.5f * static_cast<float>(level));
}

GlyphImages::GlyphImages(std::shared_ptr<const GlyphSet> glyphs, float outlineWidth)
    : _glyphs(std::move(glyphs)), _outlineWidth(std::clamp(outlineWidth, 0.0f, 0.25f))
{
    // What reaches over by less than a texel of the largest image does not show.
    const float ascii = getAsciiOverhang(*_glyphs);
    _overhang = (ascii < 1.0f / DistanceTexels ? 0.0f : std::min(ascii, 0.25f)) + _outlineWidth;
    // Ligatures may be wider than any letter; in cells nothing is.
    const bool isCells = _glyphs->getSpacing() == Spacing::Cells;
    const float cell = isCells ? _glyphs->getCellAdvance()
                               : std::min(std::max(1.5f, _glyphs->getCellAdvance()), 4.0f);
    for (int level = 0; level < Levels; ++level)
    {
        const float texel = getBoxSide(level) / TexelsPerBox;
        _levels.push_back(makeRectangle(cell, getMargin(level) + 0.5f * texel, 1.0f / texel));
    }
    place(_levels);
    _distance = makeRectangle(cell, getDistanceMargin() + 0.5f / DistanceTexels, DistanceTexels);
}

float GlyphImages::getMargin(int level) const
{
    // Half the diagonal of a square, and the texel that filtering reads beyond it.
    return _overhang + (0.7072f + 1.0f / TexelsPerBox) * getBoxSide(level);
}

/// The largest first, the others in columns beside it.
void GlyphImages::place(std::vector<ImageRectangle>& levels)
{
    int x = Gap, y = 0, columnWidth = 0;
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    {
        if (y > 0 && y + level->height > _boxesHeight)
        {
            x += columnWidth + Gap;
            y = columnWidth = 0;
        }
        moveTo(*level, x, y);
        y += level->height + Gap;
        columnWidth = std::max(columnWidth, level->width);
        _boxesHeight = std::max(_boxesHeight, level->height);
        _boxesWidth = x + columnWidth;
    }
}

std::size_t GlyphImages::getBoxesBytes() const
{
    return 4u * static_cast<std::size_t>(_boxesWidth) * static_cast<std::size_t>(_boxesHeight);
}

std::size_t GlyphImages::getDistanceBytes() const
{
    return static_cast<std::size_t>(_distance.width) * static_cast<std::size_t>(_distance.height);
}

GlyphOutline GlyphImages::getOutline(std::uint32_t code, int image) const
{
    const GlyphOutline& outline = _glyphs->getGlyph(code)->outline;
    return image ? grow(outline, _outlineWidth) : outline;
}

std::vector<std::uint8_t> GlyphImages::makeBoxes(std::uint32_t code, int image) const
{
    std::vector<std::uint8_t> pixels(getBoxesBytes());
    const GlyphOutline outline = getOutline(code, image);
    for (int channel = 0; channel < Turns; ++channel)
    {
        const float angle = static_cast<float>(channel) * 1.570796327f / Turns;
        const float c = std::cos(angle), s = std::sin(angle);
        const BoxSums sums(turn(outline, angle), CellsPerEm);
        for (int level = 0; level < Levels; ++level)
        {
            const ImageRectangle& rectangle = _levels[static_cast<std::size_t>(level)];
            for (int y = 0; y < rectangle.height; ++y)
                for (int x = 0; x < rectangle.width; ++x)
                {
                    const glm::vec2 p = getPlace(rectangle, x, y);
                    const glm::vec2 turned(c * p.x + s * p.y, c * p.y - s * p.x);
                    const int texel = (rectangle.y + y) * _boxesWidth + rectangle.x + x;
                    pixels[static_cast<std::size_t>(4 * texel + channel)] =
                        toByte(sums.getShare(turned, Narrowing * getBoxSide(level)));
                }
        }
    }
    const float advance = std::min(_glyphs->getGlyph(code)->advance, 255.0f);
    const auto fixed = static_cast<std::uint32_t>(std::lround(advance * 16777216.0));
    for (unsigned int i = 0; i < 4; ++i)
        pixels[i] = static_cast<std::uint8_t>(fixed >> (24 - 8 * i));
    return pixels;
}

float GlyphImages::getMeanCoverage(std::uint32_t code, int image) const
{
    const double ink = BoxSums(getOutline(code, image), 64).getTotal();
    return static_cast<float>(ink / std::max(1e-6f, _glyphs->getGlyph(code)->advance));
}

} // namespace osgLabels
