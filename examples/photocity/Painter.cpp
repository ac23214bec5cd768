// SPDX-License-Identifier: MIT
#include "Painter.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr int MostGrain = 64;
constexpr double FloorHeight = 3.3, WindowPitch = 3.0, Paving = 2.0;

/// Of a camera's sensor: bell-shaped, from 0 to 63.
const std::array<std::uint8_t, 65536>& grains()
{
    static const auto table = []
    {
        std::array<std::uint8_t, 65536> values{};
        CityRandom random(7);
        for (std::uint8_t& value : values)
            value = std::uint8_t(16.0 + random(0, 8) + random(0, 8) + random(0, 8) + random(0, 8));
        return values;
    }();
    return table;
}

/// Two channels at once, with a blank byte above each.
std::uint32_t mix(std::uint32_t a, std::uint32_t b, std::uint32_t weight)
{
    const std::uint32_t even = ((a & 0xff00ffu) * (256 - weight) + (b & 0xff00ffu) * weight) >> 8;
    const std::uint32_t odd =
        ((a >> 8 & 0xffu) * (256 - weight) + (b >> 8 & 0xffu) * weight) & 0xff00u;
    return (even & 0xff00ffu) | odd;
}

std::uint32_t sampleAt(const Source& source, std::int64_t u, std::int64_t v)
{
    const std::uint32_t* const at = source.pixels.data() + (v >> 16) * source.width + (u >> 16);
    const std::uint32_t right = std::uint32_t(u >> 8) & 0xff, down = std::uint32_t(v >> 8) & 0xff;
    return mix(mix(at[0], at[1], right), mix(at[source.width], at[source.width + 1], right), down);
}

int lumaOf(std::uint32_t pixel)
{
    return int((pixel & 0xff) * 77 + (pixel >> 8 & 0xff) * 150 + (pixel >> 16 & 0xff) * 29) >> 8;
}

/// Marks a share of each of `count` equal parts, from and to in shares of a part.
void repeat(std::vector<std::uint8_t>& marks, int count, double from, double to, std::uint8_t mark)
{
    const double part = double(marks.size()) / count;
    for (int i = 0; i < count; ++i)
        std::fill(marks.begin() + std::ptrdiff_t((i + from) * part),
                  marks.begin() + std::ptrdiff_t((i + to) * part), mark);
}

} // namespace

Painter::Painter(const Picture& picture, const std::vector<Source>& sources)
    : _picture(picture), _random(picture.seed),
      _source(sources[_random.choice(unsigned(sources.size()))]),
      _columns(std::size_t(picture.columns), Wall), _rows(std::size_t(picture.rows), Wall),
      _doorTop(picture.rows)
{
    choosePiece();
    chooseCurves();
    mark();
}

/// A rectangle of the picture's shape, turned, that lies within the source: no edge is seen.
void Painter::choosePiece()
{
    const bool any = _picture.use == PictureUse::Ground || _picture.use == PictureUse::Roof;
    const double angle = any ? _random(0, 2 * 3.14159265) : _random(-0.3, 0.3);
    const double c = std::cos(angle), s = std::sin(angle);
    const double shape = double(_picture.rows) / _picture.columns;
    const double width = _source.width - 4.0, height = _source.height - 4.0;
    const double widest = std::min(width / (std::abs(c) + std::abs(s) * shape),
                                   height / (std::abs(s) + std::abs(c) * shape));
    // Steps of more than two pixels would alias.
    const double across = std::min(widest * _random(0.35, 1.0), 2.0 * _picture.columns);
    const double down = across * shape;
    const double boxWidth = std::abs(c) * across + std::abs(s) * down;
    const double boxHeight = std::abs(s) * across + std::abs(c) * down;
    const double u = 2.0 + 0.5 * boxWidth + (width - boxWidth) * _random(0, 1);
    const double v = 2.0 + 0.5 * boxHeight + (height - boxHeight) * _random(0, 1);
    const double step = 65536.0 * across / _picture.columns;
    const int flip = _random.choice(2) ? -1 : 1;
    _uAcross = std::int64_t(flip * c * step);
    _vAcross = std::int64_t(flip * s * step);
    _uDown = std::int64_t(-s * step);
    _vDown = std::int64_t(c * step);
    _u = std::int64_t(65536.0 * u) - (_uAcross * _picture.columns + _uDown * _picture.rows) / 2;
    _v = std::int64_t(65536.0 * v) - (_vAcross * _picture.columns + _vDown * _picture.rows) / 2;
}

void Painter::setCurve(Part part, double gain, double offset)
{
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
        const double own = gain * _random(0.75, 1.15), power = _random(0.8, 1.25);
        for (std::size_t i = 0; i < _curves[part][channel].size(); ++i)
        {
            const double value = std::clamp((double(i) - MostGrain / 2) / 255.0, 0.0, 1.0);
            _curves[part][channel][i] =
                std::uint8_t(std::clamp(255.0 * own * std::pow(value, power) + offset, 0.0, 255.0));
        }
    }
}

void Painter::chooseCurves()
{
    switch (_picture.use)
    {
    case PictureUse::Street:
        setCurve(Wall, 0.35, 45.0);
        setCurve(Pane, 0.2, 190.0);
        break;
    case PictureUse::Ground: // The joints are what no row or column marks.
        setCurve(Wall, 0.55, 5.0);
        setCurve(Frame, 0.9, 20.0);
        break;
    default:
        setCurve(Wall, 0.85, 40.0);
        setCurve(Frame, 0.3, 170.0);
        setCurve(Pane, 0.35, 12.0);
    }
}

void Painter::mark()
{
    const auto count = [](double metres, double each)
    { return std::max(1, int(std::lround(metres / each))); };
    if (_picture.use == PictureUse::Facade)
        return markFacade();
    if (_picture.use == PictureUse::Ground)
    {
        repeat(_columns, count(_picture.width, Paving), 0.02, 0.98, Frame);
        repeat(_rows, count(_picture.height, Paving), 0.02, 0.98, Frame);
    }
    if (_picture.use == PictureUse::Street)
    {
        repeat(_columns, 1, 0.49, 0.51, Pane);
        repeat(_rows, count(_picture.height, 8.0), 0.25, 0.75, Pane);
    }
    if (_picture.use == PictureUse::Roof)
    {
        repeat(_columns, 1, 0.0, 1.0, Frame);
        repeat(_rows, 1, 0.0, 0.02, Frame);
        repeat(_rows, 1, 0.98, 1.0, Frame);
    }
}

/// Floors of windows; below them a door in the left half, so that a mirrored picture is seen.
void Painter::markFacade()
{
    const int floors = std::max(1, int(_picture.height / FloorHeight));
    const int windows = std::max(1, int(_picture.width / WindowPitch));
    const double wide = _random(0.3, 0.42), tall = _random(0.2, 0.4);
    repeat(_columns, windows, 0.46 - wide, 0.54 + wide, Frame);
    repeat(_columns, windows, 0.5 - wide, 0.48, Pane);
    repeat(_columns, windows, 0.52, 0.5 + wide, Pane);
    repeat(_rows, floors, 0.42 - tall, 0.58 + tall, Frame);
    repeat(_rows, floors, 0.5 - tall, 0.5 + tall, Pane);
    _doorTop = int(double(floors - 1) / floors * _picture.rows);
    std::fill(_rows.begin() + _doorTop, _rows.end(), Pane);
    std::fill(_rows.begin() + _doorTop, _rows.begin() + _doorTop + (_picture.rows - _doorTop) / 4,
              Wall);
    _door.assign(_columns.size(), Wall);
    const double door = 1.6 / std::max(3.2, _picture.width);
    repeat(_door, 1, 0.22 - 0.6 * door, 0.22 + 0.6 * door, Frame);
    repeat(_door, 1, 0.22 - 0.5 * door, 0.22 + 0.5 * door, Pane);
}

std::uint32_t Painter::sample(int x, int y) const
{
    return sampleAt(_source, _u + x * _uAcross + y * _uDown, _v + x * _vAcross + y * _vDown);
}

void Painter::paint(int y, std::uint8_t* row) const
{
    const auto& grain = grains();
    const std::uint32_t start = (_picture.seed + std::uint32_t(y)) * 0x9e3779b1u >> 16;
    const Marks& columns = y >= _doorTop ? _door : _columns;
    const std::uint8_t rowPart = _rows[std::size_t(y)];
    const bool toGrey = _picture.grey || _picture.use == PictureUse::Street;
    std::int64_t u = _u + y * _uDown, v = _v + y * _vDown;
    for (int x = 0; x < _picture.columns; ++x, u += _uAcross, v += _vAcross)
    {
        const auto& curves = _curves[std::min(columns[std::size_t(x)], rowPart)];
        const std::uint32_t pixel = sampleAt(_source, u, v);
        const std::uint32_t noise = grain[(start + std::uint32_t(x)) & 0xffff];
        if (toGrey)
        {
            const std::uint8_t value = curves[0][std::uint32_t(lumaOf(pixel)) + noise];
            for (int i = _picture.grey ? 1 : 3; i > 0; --i)
                *row++ = value;
            continue;
        }
        *row++ = curves[0][(pixel & 0xff) + noise];
        *row++ = curves[1][(pixel >> 8 & 0xff) + noise];
        *row++ = curves[2][(pixel >> 16 & 0xff) + noise];
    }
}
