// SPDX-License-Identifier: MIT
#include "ExactMask.h"

#include <algorithm>
#include <cmath>

using namespace osgPagedTexture;

ExactMask::ExactMask(const Photo& photo)
    : _width(photo.width), _height(photo.height),
      _used(std::size_t(photo.width) * std::size_t(photo.height)), _edge(_used.size())
{
    for (const PhotoSurface& surface : photo.surfaces)
        for (std::size_t i = 0; 3 * i < surface.coordinates.size(); ++i)
            add(surface, i);
}

void ExactMask::mark(std::int64_t x, std::int64_t y, bool inside, bool atEdge)
{
    const std::size_t pixel = std::size_t(y) * std::size_t(_width) + std::size_t(x);
    _used[pixel] |= inside;
    _edge[pixel] |= atEdge;
}

void ExactMask::addRepeat(const double (&x)[3], const double (&y)[3])
{
    const auto firstOf = [](const double(&v)[3]) {
        return std::int64_t(std::max(0.0, std::floor(std::min({v[0], v[1], v[2]}) - 1.0)));
    };
    const auto endOf = [](const double(&v)[3], int size)
    {
        return std::int64_t(
            std::clamp(std::ceil(std::max({v[0], v[1], v[2]}) + 1.0), 0.0, double(size)));
    };
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    const double turn = area < 0.0 ? -1.0 : 1.0;
    for (std::int64_t row = firstOf(y); row < endOf(y, _height); ++row)
    {
        for (std::int64_t column = firstOf(x); column < endOf(x, _width); ++column)
        {
            double nearest = 1e300;
            for (int i = 0; i < 3; ++i)
            {
                const int j = (i + 1) % 3;
                const double dx = x[j] - x[i], dy = y[j] - y[i];
                const double side =
                    turn * (dx * (double(row) + 0.5 - y[i]) - dy * (double(column) + 0.5 - x[i]));
                const double length = std::hypot(dx, dy);
                nearest = std::min(nearest, length > 0.0 ? side / length : 0.0);
            }
            mark(column, row, area != 0.0 && nearest >= 0.0, std::abs(nearest) <= EdgeReach);
        }
    }
}

void ExactMask::addClamped(const PhotoSurface& surface, std::size_t index)
{
    // The pixels of an edge stand for all that lies behind them: each pixel's middle line is cut
    // with the triangle. Many points on a line stand for the line, which is enough for a test.
    constexpr int Points = 4000;
    const glm::vec2* corner = &surface.coordinates[3 * index];
    for (int i = 0; i <= Points; ++i)
    {
        for (int j = 0; i + j <= Points; ++j)
        {
            const double a = double(i) / Points, b = double(j) / Points, c = 1.0 - a - b;
            const double u = a * corner[0].x + b * corner[1].x + c * corner[2].x;
            const double v = a * corner[0].y + b * corner[1].y + c * corner[2].y;
            if (u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0)
                continue;
            const auto column = std::int64_t(std::clamp(std::floor(u * _width), 0.0, _width - 1.0));
            const auto row = std::int64_t(std::clamp(std::floor(v * _height), 0.0, _height - 1.0));
            const double x = u * _width - double(column) - 0.5;
            const double y = v * _height - double(row) - 0.5;
            // A point counts where it is on the middle line, to the distance of points.
            const bool outS = u < 0.0 || u > 1.0, outT = v < 0.0 || v > 1.0;
            const bool middle = (outS || std::abs(x) < 0.1) && (outT || std::abs(y) < 0.1);
            mark(column, row, middle, !middle);
        }
    }
}

void ExactMask::add(const PhotoSurface& surface, std::size_t index)
{
    const glm::vec2* corner = &surface.coordinates[3 * index];
    const auto cellsOf = [&](int axis, PhotoWrap wrap)
    {
        const double low = std::min({corner[0][axis], corner[1][axis], corner[2][axis]});
        const double high = std::max({corner[0][axis], corner[1][axis], corner[2][axis]});
        return wrap == PhotoWrap::Clamp
                   ? std::pair<std::int64_t, std::int64_t>(0, 0)
                   : std::pair(std::int64_t(std::floor(low)), std::int64_t(std::floor(high)));
    };
    const auto move = [](double value, std::int64_t cell, PhotoWrap wrap)
    {
        const double moved = value - double(cell);
        return wrap == PhotoWrap::Mirror && cell % 2 != 0 ? 1.0 - moved : moved;
    };
    const auto [left, right] = cellsOf(0, surface.wrapS);
    const auto [bottom, top] = cellsOf(1, surface.wrapT);
    for (std::int64_t t = bottom; t <= top; ++t)
    {
        for (std::int64_t s = left; s <= right; ++s)
        {
            double x[3], y[3];
            for (int i = 0; i < 3; ++i)
            {
                x[i] = move(corner[i].x, s, surface.wrapS) * _width;
                y[i] = move(corner[i].y, t, surface.wrapT) * _height;
            }
            addRepeat(x, y);
        }
    }
    const auto leaves = [&](int axis)
    {
        return std::any_of(corner, corner + 3,
                           [&](const glm::vec2& each)
                           { return each[axis] < 0.0f || each[axis] > 1.0f; });
    };
    if (surface.wrapS == PhotoWrap::Clamp && surface.wrapT == PhotoWrap::Clamp &&
        (leaves(0) || leaves(1)))
        addClamped(surface, index);
}

Pixels ExactMask::getMask() const
{
    Pixels mask(_width, _height, 1);
    for (std::size_t i = 0; i < _used.size(); ++i)
        mask.bytes[i] = _used[i] || _edge[i] ? 255 : 0;
    return mask;
}

ExactMask::Difference ExactMask::compare(const Pixels& mask) const
{
    Difference difference;
    for (std::size_t i = 0; i < _used.size(); ++i)
    {
        difference.used += _used[i];
        difference.edges += _edge[i];
        if ((mask.bytes[i] != 0) != (_used[i] != 0))
            ++(_edge[i] ? difference.atEdges : difference.wrong);
    }
    return difference;
}
