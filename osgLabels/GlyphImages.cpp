// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphImages.h>

#include <osgLabels/BoxSums.h>
#include <osgLabels/InkSpans.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

constexpr int TexelsPerBox = 4;
/// Bilinear filtering widens what it reads: a square of side w has the variance w^2 / 12, a texel
/// of filtering adds 1/6. Squares are made narrower by half of that, which leaves the least error.
constexpr float Narrowing = 1.0f;
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

/// em
float getTexel(int level)
{
    return getBoxSide(level + 1) / TexelsPerBox;
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
        const float texel = getTexel(level);
        _levels.push_back(makeRectangle(cell, getMargin(level) + 0.5f * texel, 1.0f / texel));
    }
    _distance = makeRectangle(cell, getDistanceMargin() + 0.5f / DistanceTexels, DistanceTexels);
    _quarterStep = glm::ivec2(_distance.width / 2, _distance.height / 2);
    _distance.width += 2 - _quarterStep.x;
    _distance.height += 2 - _quarterStep.y;
    place();
}

float GlyphImages::getMargin(int level) const
{
    // Half the diagonal of a square, and the texel that filtering reads beyond it.
    return _overhang + 0.7072f * getBoxSide(level) + getTexel(level);
}

/// In columns as high as the largest, each where it fits first; they come by falling height.
void GlyphImages::place()
{
    std::vector<ImageRectangle*> rectangles{&_distance};
    for (ImageRectangle& level : _levels)
        rectangles.push_back(&level);
    std::sort(rectangles.begin(), rectangles.end(),
              [](const ImageRectangle* a, const ImageRectangle* b)
              { return a->height > b->height; });
    struct Column
    {
        int x, height;
    };
    std::vector<Column> columns;
    _height = rectangles.front()->height;
    _width = Gap; // the first texel is the advance
    for (ImageRectangle* const rectangle : rectangles)
    {
        auto column = std::find_if(columns.begin(), columns.end(),
                                   [&](const Column& candidate)
                                   { return candidate.height + rectangle->height <= _height; });
        if (column == columns.end())
        {
            column = columns.insert(column, {_width, 0});
            _width += rectangle->width + Gap;
        }
        moveTo(*rectangle, column->x, column->height);
        column->height += rectangle->height + Gap;
    }
}

std::size_t GlyphImages::getBytes() const
{
    return 4u * static_cast<std::size_t>(_width) * static_cast<std::size_t>(_height);
}

GlyphOutline GlyphImages::getOutline(std::uint32_t code, int which) const
{
    const GlyphOutline& outline = _glyphs->getGlyph(code)->outline;
    return which ? grow(outline, _outlineWidth) : outline;
}

std::vector<std::uint8_t> GlyphImages::make(std::uint32_t code, int which) const
{
    std::vector<std::uint8_t> pixels(getBytes());
    const GlyphOutline outline = getOutline(code, which);
    drawBoxes(outline, pixels);
    drawDistances(outline, pixels);
    const float advance = std::min(_glyphs->getGlyph(code)->advance, 255.0f);
    const auto fixed = static_cast<std::uint32_t>(std::llround(advance * 16777216.0));
    for (unsigned int i = 0; i < 4; ++i)
        pixels[i] = static_cast<std::uint8_t>(fixed >> (24 - 8 * i));
    return pixels;
}

void GlyphImages::drawBoxes(const GlyphOutline& outline, std::vector<std::uint8_t>& pixels) const
{
    for (int channel = 0; channel < 4; ++channel)
    {
        const float angle = channel % 2 ? 0.785398163f : 0.0f;
        const float c = std::cos(angle), s = std::sin(angle);
        const BoxSums sums(turn(outline, angle), CellsPerEm);
        for (int level = 0; level < Levels; ++level)
        {
            const ImageRectangle& rectangle = _levels[static_cast<std::size_t>(level)];
            const float side = getBoxSide(level + channel / 2), texel = getTexel(level);
            const float narrowed = std::sqrt(side * side - Narrowing * texel * texel);
            for (int y = 0; y < rectangle.height; ++y)
                for (int x = 0; x < rectangle.width; ++x)
                {
                    const glm::vec2 p = getPlace(rectangle, x, y);
                    const glm::vec2 turned(c * p.x + s * p.y, c * p.y - s * p.x);
                    const int i = (rectangle.y + y) * _width + rectangle.x + x;
                    pixels[static_cast<std::size_t>(4 * i + channel)] =
                        toByte(sums.getShare(turned, narrowed));
                }
        }
    }
}

float GlyphImages::getMeanCoverage(std::uint32_t code, int which) const
{
    const double ink = BoxSums(getOutline(code, which), 64).getTotal();
    return static_cast<float>(ink / std::max(1e-6f, _glyphs->getGlyph(code)->advance));
}

} // namespace osgLabels
