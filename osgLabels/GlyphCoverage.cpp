// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphCoverage.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgLabels
{

namespace
{

// The constants of coverage.glsl.
constexpr float LargeFrom = 24.0f, HugeFrom = 48.0f, Nearing = 8.0f, MostLong = 12.0f,
                MostTurns = 16.0f;

/// A footprint cut across its long axis: osgLabels_Slicing.
class Slicing
{
public:
    Slicing(const glm::vec2& a, const glm::vec2& b, const glm::vec2& twice, float axis, float area)
        : _a(a), _b(b)
    {
        const glm::vec2 direction = twice.x > 0.0f ? glm::vec2(axis + twice.x, twice.y)
                                                   : glm::vec2(twice.y, axis - twice.x);
        const float length = std::max(glm::length(direction), 1e-18f);
        _run = glm::vec2(glm::dot(_a, direction), glm::dot(_b, direction)) / length;
        _a *= _run.x < 0.0f ? -1.0f : 1.0f;
        _b *= _run.y < 0.0f ? -1.0f : 1.0f;
        _run = glm::abs(_run);
        if (_run.x < _run.y)
        {
            std::swap(_a, _b);
            std::swap(_run.x, _run.y);
        }
        _inverse = 1.0f / glm::max(_run, 1e-18f);
        _end = 0.5f * (_run.x + _run.y);
        _shoulder = 0.5f * (_run.x - _run.y);
        height = area * _inverse.x;
        skew = _run.y * _inverse.x;
    }

    glm::vec3 upTo(float share) const
    {
        const float rest = 1.0f - share;
        const float end = _end * share * (1.0f + bend * rest * rest);
        const float over = std::max(end - _shoulder, 0.0f);
        const float fallen = over * std::min(over * _inverse.y, 1.0f);
        return {end, end - 0.5f * fallen,
                0.5f * end * end - fallen * (0.5f * _shoulder + over / 3.0f)};
    }

    glm::vec3 getSquare(const glm::vec3& slice) const
    {
        const float along = slice.z / slice.y;
        const float t = 0.5f * glm::clamp((along - _shoulder) * _inverse.y, 0.0f, 1.0f);
        const float s = (along - t * _run.y) * _inverse.x;
        const float side = std::max(height * (1.0f - 2.0f * t), 0.6f * slice.x);
        return {s * _a + t * _b, side * side};
    }

    float height, skew, bend = 0.0f;

private:
    glm::vec2 _a, _b, _run, _inverse;
    float _end, _shoulder;
};

} // namespace

struct GlyphCoverage::Cell
{
    int index;
    float left, width; ///< em
};

struct GlyphCoverage::Sampling
{
    const ImageRectangle* rectangle;
    float margin;
    bool isDistance;
    float finer, turn;
    int which;
};

GlyphCoverage::GlyphCoverage(std::shared_ptr<const GlyphSet> glyphs, float outlineWidth)
    : _glyphs(std::move(glyphs)), _images(_glyphs, outlineWidth)
{
    double sum = 0.0;
    for (std::uint32_t code = 0; code < _glyphs->getSize(); ++code)
    {
        for (int which = 0; which < _images.getImagesPerGlyph(); ++which)
            _pixels.push_back(_images.make(code, which));
        _advances.push_back(_glyphs->getGlyph(code)->advance);
        sum += _images.getMeanCoverage(code, 0);
    }
    _mean = static_cast<float>(sum / std::max<std::size_t>(1, _advances.size()));
}

float GlyphCoverage::getAdvance(const std::vector<std::uint32_t>& codes, int index) const
{
    if (_glyphs->getSpacing() == Spacing::Cells)
        return _glyphs->getCellAdvance();
    const bool isInside = index >= 0 && index < static_cast<int>(codes.size());
    return isInside ? _advances[codes[static_cast<std::size_t>(index)]] : 0.0f;
}

float GlyphCoverage::getWidth(const std::vector<std::uint32_t>& codes) const
{
    float width = 0.0f;
    for (int i = 0; i < static_cast<int>(codes.size()); ++i)
        width += getAdvance(codes, i);
    return width;
}

GlyphCoverage::Cell GlyphCoverage::getCell(const std::vector<std::uint32_t>& codes, float x) const
{
    if (_glyphs->getSpacing() == Spacing::Cells)
    {
        const float width = _glyphs->getCellAdvance();
        const float index = std::floor(x * (1.0f / width));
        return {static_cast<int>(index), index * width, width};
    }
    Cell cell{-1, 0.0f, 0.0f};
    if (x < 0.0f)
        return cell;
    while (x >= cell.left + cell.width && cell.index < static_cast<int>(codes.size()))
    {
        cell.left += cell.width;
        cell.width = getAdvance(codes, ++cell.index);
    }
    return cell;
}

GlyphCoverage::Cell GlyphCoverage::getNeighbour(const std::vector<std::uint32_t>& codes,
                                                const Cell& cell, int step) const
{
    const float width = getAdvance(codes, cell.index + step);
    return {cell.index + step, step > 0 ? cell.left + cell.width : cell.left - width, width};
}

glm::vec4 GlyphCoverage::read(std::size_t image, const glm::vec2& texel) const
{
    const glm::vec2 from = texel - 0.5f;
    const glm::ivec2 low(glm::floor(from));
    const glm::vec2 f = from - glm::vec2(low);
    const auto get = [&](int x, int y)
    {
        x = std::clamp(x, 0, _images.getWidth() - 1);
        y = std::clamp(y, 0, _images.getHeight() - 1);
        const std::uint8_t* const bytes =
            &_pixels[image][4 * static_cast<std::size_t>(y * _images.getWidth() + x)];
        return glm::vec4(bytes[0], bytes[1], bytes[2], bytes[3]) / 255.0f;
    };
    return glm::mix(glm::mix(get(low.x, low.y), get(low.x + 1, low.y), f.x),
                    glm::mix(get(low.x, low.y + 1), get(low.x + 1, low.y + 1), f.x), f.y);
}

float GlyphCoverage::getLetterInk(const std::vector<std::uint32_t>& codes, const Cell& cell,
                                  glm::vec2 place, const Sampling& sampling,
                                  const glm::vec4& lookUp) const
{
    if (cell.index < 0 || cell.index >= static_cast<int>(codes.size()))
        return 0.0f;
    place.x -= cell.left;
    place = glm::clamp(place, glm::vec2(-sampling.margin),
                       glm::vec2(cell.width, 1.0f) + sampling.margin);
    glm::vec2 texel = place * sampling.rectangle->scale + sampling.rectangle->offset;
    glm::vec2 mixing(lookUp);
    if (sampling.isDistance)
    {
        const ImageRectangle& whole = _images.getDistance();
        const glm::vec2 step(_images.getQuarterStep());
        const glm::vec2 end = step + glm::vec2(whole.x, whole.y) + 0.5f;
        const glm::vec2 quarter(texel.x >= end.x, texel.y >= end.y);
        texel -= quarter * step;
        mixing += quarter;
    }
    const std::size_t image = codes[static_cast<std::size_t>(cell.index)] *
                                  static_cast<std::size_t>(_images.getImagesPerGlyph()) +
                              static_cast<std::size_t>(sampling.which);
    const glm::vec4 texels = read(image, texel);
    const float value = glm::mix(glm::mix(texels.x, texels.y, mixing.x),
                                 glm::mix(texels.z, texels.w, mixing.x), mixing.y);
    return glm::clamp(value * lookUp.z + lookUp.w, 0.0f, 1.0f);
}

GlyphCoverage::Sampling GlyphCoverage::getSampling(float squared, float turn) const
{
    if (squared * LargeFrom * LargeFrom < 1.0f)
        return {&_images.getDistance(), _images.getDistanceMargin(), true, 0.0f, 0.0f, 0};
    const int level = std::clamp(-3 - std::ilogb(0.8f * squared), 0, GlyphImages::Levels - 1);
    return {&_images.getLevels()[static_cast<std::size_t>(level)],
            _images.getMargin(level),
            false,
            std::ldexp(1.0f, level + 3),
            turn,
            0};
}

glm::vec4 GlyphCoverage::getLookUp(const Sampling& sampling, float squared)
{
    const float gain = GlyphImages::DistanceSpread / std::sqrt(squared);
    if (sampling.isDistance)
        return {0.0f, 0.0f, 2.0f * gain, 0.5f - gain};
    const float part = squared * sampling.finer;
    return {sampling.turn, glm::clamp((2.0f - part) * (4.0f - part) / 3.0f, -0.5f, 1.5f), 1.0f,
            0.0f};
}

float GlyphCoverage::getInk(const std::vector<std::uint32_t>& codes, const glm::vec2& place,
                            const glm::mat2& footprint, int which) const
{
    const glm::vec2 a = footprint[0], b = footprint[1];
    const glm::vec2 columns = a * a + b * b;
    const float squares = columns.x + columns.y;
    const float area = std::max(std::abs(a.x * b.y - a.y * b.x), 1e-30f);
    const float legible = glm::clamp(
        2.0f / std::sqrt(std::max(area * _legibleSize * _legibleSize, 1e-30f)) - 1.0f, 0.0f, 1.0f);
    if (!(legible > 0.0f))
        return _mean;

    const glm::vec2 twice(0.5f * (columns.x - columns.y), a.x * a.y + b.x * b.y);
    const float axis = glm::length(twice);
    const bool isLong = squares > 2.26f * area;
    Slicing slicing(a, b, twice, axis, area);
    const float ratio = std::min((0.5f * squares + axis) / area, MostLong);
    const float slices = ratio + slicing.skew * (0.6f * ratio + 0.5f);

    const float pixels = 1.0f / std::sqrt(area);
    const float nearing = glm::clamp((HugeFrom - pixels) / Nearing, 0.0f, 1.0f);
    const float spread = squares > 2.02f * area ? 1.0f : pixels < LargeFrom ? 0.0f : nearing;
    const float quartered = area * (1.0f - 0.75f * spread * spread);
    const bool isPair = !isLong && spread == 0.0f;

    const float typical =
        isLong ? slicing.height * slicing.height * (1.0f - 0.4f * slicing.skew) : quartered;
    const glm::vec2 doubled = isLong ? twice : glm::vec2(a.x * a.x - a.y * a.y, 2.0f * a.x * a.y);
    const float turn = doubled.y * doubled.y / std::max(glm::dot(doubled, doubled), 1e-36f);
    Sampling sampling = getSampling(typical, turn);
    sampling.which = which;

    const float turns = isLong   ? glm::clamp(std::ceil(0.5f * slices - 0.2f), 1.0f, MostTurns)
                        : isPair ? 1.0f
                                 : 2.0f;
    const float perTurn = 1.0f / turns;
    slicing.bend = slicing.skew * (0.3f + 1.2f * perTurn);
    float ink = 0.0f, weight = 0.0f;
    glm::vec3 before(0.0f);
    for (float i = 0.0f; i < turns; i += 1.0f)
    {
        const glm::vec2 off = spread * (0.25f * a + (i > 0.0f ? -0.25f : 0.25f) * b);
        const glm::vec3 upTo = slicing.upTo((i + 1.0f) * perTurn), slice = upTo - before;
        before = upTo;
        const glm::vec3 square = isLong ? slicing.getSquare(slice) : glm::vec3(off, quartered);
        const float part = isLong ? slice.y : 1.0f;
        const glm::vec4 lookUp = getLookUp(sampling, square.z);
        const glm::vec2 at = place + glm::vec2(square), opposite = place - glm::vec2(square);
        const Cell cell = getCell(codes, at.x);
        const int step = at.x - cell.left < 0.5f * cell.width ? -1 : 1;
        const Cell other = isPair ? getNeighbour(codes, cell, step) : getCell(codes, opposite.x);
        ink += part * (getLetterInk(codes, cell, at, sampling, lookUp) +
                       getLetterInk(codes, other, opposite, sampling, lookUp));
        weight += isPair ? part : 2.0f * part;
    }
    return glm::mix(_mean, glm::clamp(ink / weight, 0.0f, 1.0f), legible);
}

} // namespace osgLabels
