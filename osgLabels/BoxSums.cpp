// SPDX-License-Identifier: MIT
#include <osgLabels/BoxSums.h>

#include <osgLabels/InkSpans.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

BoxSums::BoxSums(const GlyphOutline& outline, int cellsPerEm) : _cellsPerEm(cellsPerEm)
{
    const OutlineBounds bounds = getBounds(outline);
    const auto cells = static_cast<float>(cellsPerEm);
    const InkSpans ink(outline, cellsPerEm);
    _left = static_cast<int>(std::floor(bounds.low.x * cells));
    _bottom = ink.getFirstRow();
    _width = static_cast<int>(std::ceil(bounds.high.x * cells)) - _left + 1;
    _height = std::max(0, ink.getEndRow() - _bottom);
    const std::size_t stride = static_cast<std::size_t>(_width) + 1;
    _sums.assign(stride * (static_cast<std::size_t>(_height) + 1), 0.0);
    std::vector<double> row(stride);
    for (int y = 0; y < _height; ++y)
    {
        std::fill(row.begin(), row.end(), 0.0);
        const float* const end = ink.end(_bottom + y);
        for (const float* edge = ink.begin(_bottom + y); edge < end; edge += 2)
            for (int x = static_cast<int>(std::floor(edge[0] * cells)); x < edge[1] * cells; ++x)
                row[static_cast<std::size_t>(x - _left)] +=
                    std::min<double>(edge[1] * cells, x + 1) - std::max<double>(edge[0] * cells, x);
        double sum = 0.0;
        double* const below = &_sums[stride * static_cast<std::size_t>(y)];
        for (std::size_t x = 0; x + 1 < stride; ++x)
        {
            sum += row[x] / (static_cast<double>(cellsPerEm) * cellsPerEm);
            below[stride + x + 1] = below[x + 1] + sum;
        }
    }
}

double BoxSums::getSum(double x, double y) const
{
    x = std::clamp(x * _cellsPerEm - _left, 0.0, static_cast<double>(_width));
    y = std::clamp(y * _cellsPerEm - _bottom, 0.0, static_cast<double>(_height));
    const int i = std::min(static_cast<int>(x), _width - 1);
    const int j = std::max(0, std::min(static_cast<int>(y), _height - 1));
    const double f = x - i, g = _height ? y - j : 0.0;
    const auto stride = static_cast<std::size_t>(_width) + 1;
    const double* const low = &_sums[stride * static_cast<std::size_t>(j)] + i;
    const double* const high = _height ? low + stride : low;
    return (low[0] * (1.0 - f) + low[1] * f) * (1.0 - g) + (high[0] * (1.0 - f) + high[1] * f) * g;
}

float BoxSums::getShare(const glm::vec2& center, float side) const
{
    const double half = 0.5 * side, x = center.x, y = center.y;
    const double ink = getSum(x + half, y + half) - getSum(x - half, y + half) -
                       getSum(x + half, y - half) + getSum(x - half, y - half);
    return static_cast<float>(std::clamp(ink / (4.0 * half * half), 0.0, 1.0));
}

} // namespace osgLabels
