// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BoxReducer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace osgPagedTexture
{

namespace
{

double toLinear(double value)
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double toSrgb(double value)
{
    return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

const std::array<float, 256>& decodeTable(bool linearLight)
{
    static const auto make = [](bool linear)
    {
        std::array<float, 256> table{};
        for (int i = 0; i < 256; ++i)
        {
            table[i] = static_cast<float>(linear ? toLinear(i / 255.0) : i / 255.0);
        }
        return table;
    };
    static const std::array<float, 256> tables[2] = {make(false), make(true)};
    return tables[linearLight];
}

/// Linear light in 1/65535 to sRGB: at its steepest, in the dark, a step is 1/20 of a code value.
std::uint8_t encodeSrgb(float value)
{
    static const std::vector<std::uint8_t> table = []
    {
        std::vector<std::uint8_t> made(65536);
        for (int i = 0; i < 65536; ++i)
        {
            made[i] = static_cast<std::uint8_t>(std::lround(toSrgb(i / 65535.0) * 255.0));
        }
        return made;
    }();
    return table[static_cast<int>(std::clamp(value, 0.0f, 1.0f) * 65535.0f + 0.5f)];
}

std::uint8_t encodePlain(float value)
{
    return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

} // namespace

BoxReducer::BoxReducer(const Shape& shape, Sink sink)
    : _shape(shape), _sink(std::move(sink)), _alpha(shape.channels == 2 || shape.channels == 4),
      _line(std::size_t(shape.width) * shape.channels),
      _row(std::size_t(shape.targetWidth) * shape.channels), _sum(_row.size()),
      _finished(_row.size())
{
    const double scale = shape.extentX / shape.targetWidth;
    for (int x = 0; x < shape.targetWidth; ++x)
    {
        const double from = x * scale;
        const double to = std::min((x + 1) * scale, shape.extentX);
        Span span{std::min(static_cast<int>(from), shape.width - 1), {}};
        for (int column = span.first; column < shape.width && column < to; ++column)
        {
            const double cover = std::min(to, column + 1.0) - std::max(from, double(column));
            span.weights.push_back(static_cast<float>(cover / (to - from)));
        }
        _spans.push_back(std::move(span));
    }
}

void BoxReducer::reduceRow(const std::uint8_t* row)
{
    const int channels = _shape.channels;
    const int colours = channels - _alpha;
    const std::array<float, 256>& decode = decodeTable(_shape.linearLight);
    for (int x = 0; x < _shape.width; ++x)
    {
        const std::uint8_t* pixel = row + std::size_t(x) * channels;
        float* line = _line.data() + std::size_t(x) * channels;
        const float alpha = _alpha ? pixel[colours] / 255.0f : 1.0f;
        for (int c = 0; c < colours; ++c)
        {
            line[c] = decode[pixel[c]] * alpha;
        }
        if (_alpha)
        {
            line[colours] = alpha;
        }
    }
    for (int x = 0; x < _shape.targetWidth; ++x)
    {
        const Span& span = _spans[x];
        float sum[4] = {};
        const float* line = _line.data() + std::size_t(span.first) * channels;
        for (float weight : span.weights)
        {
            for (int c = 0; c < channels; ++c)
            {
                sum[c] += weight * line[c];
            }
            line += channels;
        }
        std::copy(sum, sum + channels, _row.data() + std::size_t(x) * channels);
    }
}

void BoxReducer::finishTexelRow()
{
    const int channels = _shape.channels;
    const int colours = channels - _alpha;
    for (std::size_t at = 0; at < _sum.size(); at += channels)
    {
        const float alpha = _alpha ? _sum[at + colours] : 1.0f;
        for (int c = 0; c < colours; ++c)
        {
            const float value = alpha > 0.0f ? _sum[at + c] / alpha : 0.0f;
            _finished[at + c] = _shape.linearLight ? encodeSrgb(value) : encodePlain(value);
        }
        if (_alpha)
        {
            _finished[at + colours] = encodePlain(alpha);
        }
    }
    std::fill(_sum.begin(), _sum.end(), 0.0f);
    _sink(_finished.data(), _texelRow++);
}

void BoxReducer::add(const std::uint8_t* row)
{
    const int y = _rowsAdded++;
    const double scale = _shape.extentY / _shape.targetHeight;
    if (y >= _shape.extentY || _texelRow >= _shape.targetHeight)
    {
        return;
    }
    reduceRow(row);
    const double bottom = std::min(y + 1.0, _shape.extentY);
    for (double top = y; _texelRow < _shape.targetHeight;)
    {
        const bool last = _texelRow == _shape.targetHeight - 1;
        const double end = last ? _shape.extentY : (_texelRow + 1) * scale;
        const float weight = static_cast<float>((std::min(bottom, end) - top) / scale);
        for (std::size_t i = 0; i < _sum.size(); ++i)
        {
            _sum[i] += weight * _row[i];
        }
        if (bottom < end)
        {
            break;
        }
        finishTexelRow();
        top = end;
        if (top >= bottom)
        {
            break;
        }
    }
}

} // namespace osgPagedTexture
