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
constexpr float LargeFrom = 20.0f, HugeFrom = 44.0f, Slices = 2.5f, MostSlices = 32.0f;

/// A footprint cut across its long axis.
class Slicing
{
public:
    Slicing(glm::vec2 a, glm::vec2 b, const glm::vec2& twice, float axis, float count)
        : _a(a), _b(b), _count(count)
    {
        const glm::vec2 direction = twice.x > 0.0f ? glm::vec2(axis + twice.x, twice.y)
                                                   : glm::vec2(twice.y, axis - twice.x);
        _run = {glm::dot(_a, direction), glm::dot(_b, direction)};
        _a *= _run.x < 0.0f ? -1.0f : 1.0f;
        _b *= _run.y < 0.0f ? -1.0f : 1.0f;
        _run = glm::abs(_run);
        if (_run.x < _run.y)
        {
            std::swap(_a, _b);
            std::swap(_run.x, _run.y);
        }
    }

    /// The slice's middle from that of the footprint, and its width.
    glm::vec3 get(float i) const
    {
        const glm::vec2 inverse = 1.0f / glm::max(_run, 1e-25f);
        const float along = (i + 0.5f - 0.5f * _count) * (_run.x + _run.y) / _count;
        const float low = glm::clamp((along - 0.5f * _run.x) * inverse.y, -0.5f, 0.5f);
        const float high = glm::clamp((along + 0.5f * _run.x) * inverse.y, -0.5f, 0.5f);
        const float t = 0.5f * (low + high), s = (along - t * _run.y) * inverse.x;
        return {s * _a + t * _b, high - low};
    }

private:
    glm::vec2 _a, _b, _run;
    float _count;
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
    glm::vec4 mixing;
    bool isDistance;
    glm::vec2 gain;
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
                                  glm::vec2 place, const Sampling& sampling) const
{
    if (cell.index < 0 || cell.index >= static_cast<int>(codes.size()))
        return 0.0f;
    place.x -= cell.left;
    place = glm::clamp(place, glm::vec2(-sampling.margin),
                       glm::vec2(cell.width, 1.0f) + sampling.margin);
    glm::vec2 texel = place * sampling.rectangle->scale + sampling.rectangle->offset;
    glm::vec4 mixing = sampling.mixing;
    if (sampling.isDistance)
    {
        const ImageRectangle& whole = _images.getDistance();
        const glm::vec2 step(_images.getQuarterStep());
        const glm::vec2 end = step + glm::vec2(whole.x, whole.y) + 0.5f;
        const int right = texel.x >= end.x, upper = texel.y >= end.y;
        texel -= glm::vec2(right, upper) * step;
        mixing = glm::vec4(0.0f);
        mixing[right + 2 * upper] = 1.0f;
    }
    const std::size_t image = codes[static_cast<std::size_t>(cell.index)] *
                                  static_cast<std::size_t>(_images.getImagesPerGlyph()) +
                              static_cast<std::size_t>(sampling.which);
    const float value = glm::dot(read(image, texel), mixing);
    return glm::clamp(value * sampling.gain.x + sampling.gain.y, 0.0f, 1.0f);
}

GlyphCoverage::Sampling GlyphCoverage::getSampling(float squared, const glm::vec2& doubled,
                                                   bool isQuartered) const
{
    const float pixels = 1.0f / std::sqrt(squared);
    const float level = glm::clamp(-std::log2(squared) - 2.0f, 0.0f, 6.999f);
    const float finer = level - std::floor(level);
    const float turn = doubled.y * doubled.y / std::max(glm::dot(doubled, doubled), 1e-36f);
    const float gain = (isQuartered ? 2.0f : 1.0f) * GlyphImages::DistanceSpread * pixels;
    if (pixels > LargeFrom)
        return {&_images.getDistance(),
                _images.getDistanceMargin(),
                {},
                true,
                {2.0f * gain, 0.5f - gain},
                0};
    const int coarse = static_cast<int>(level);
    return {&_images.getLevels()[static_cast<std::size_t>(coarse)],
            _images.getMargin(coarse),
            glm::vec4(1.0f - turn, turn, 1.0f - turn, turn) *
                glm::vec4(1.0f - finer, 1.0f - finer, finer, finer),
            false,
            {1.0f, 0.0f},
            0};
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
    const float longest = 0.5f * squares + axis;
    const bool isLong = squares > 2.2f * area;
    const float ratio = isLong ? longest / area : 1.0f;
    constexpr float Least = Slices / MostSlices;
    const float squared = std::max(area / ratio, isLong ? longest * Least * Least : 0.0f);
    const float pixels = 1.0f / std::sqrt(squared);
    const bool isQuartered = pixels > LargeFrom && !isLong && pixels < HugeFrom;
    const float count = isLong        ? std::min(std::ceil(Slices * ratio), MostSlices)
                        : isQuartered ? 4.0f
                                      : 1.0f;
    const glm::vec2 doubled = isLong ? twice : glm::vec2(a.x * a.x - a.y * a.y, 2.0f * a.x * a.y);
    Sampling sampling = getSampling(squared, doubled, isQuartered);
    sampling.which = which;

    const Slicing slicing(a, b, twice, axis, count);
    float ink = 0.0f, weight = 0.0f;
    for (float i = 0.0f; i < count; i += 1.0f)
    {
        const float row = std::floor(0.5f * i);
        const glm::vec2 quarter((i - 2.0f * row) * 0.5f - 0.25f, row * 0.5f - 0.25f);
        glm::vec3 slice(0.0f, 0.0f, 1.0f);
        if (isLong)
            slice = slicing.get(i);
        else if (isQuartered)
            slice = glm::vec3(footprint * quarter, 1.0f);
        const glm::vec2 at = place + glm::vec2(slice);
        const Cell cell = getCell(codes, at.x);
        ink += slice.z * getLetterInk(codes, cell, at, sampling);
        if (count == 1.0f && !isLong)
        {
            const int step = at.x - cell.left < 0.5f * cell.width ? -1 : 1;
            ink += getLetterInk(codes, getNeighbour(codes, cell, step), at, sampling);
        }
        weight += slice.z;
    }
    return glm::mix(_mean, std::min(ink / weight, 1.0f), legible);
}

} // namespace osgLabels
