// SPDX-License-Identifier: MIT
#include <osgLabels/InkSpans.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

struct Crossing
{
    float x;
    int winding;
};

using Rows = std::vector<std::vector<Crossing>>;

/// Enters where the side from `a` to `b` crosses the middles of rows.
void cross(Rows& rows, int firstRow, int rowsPerEm, const glm::dvec2& a, const glm::dvec2& b)
{
    const glm::dvec2& low = a.y < b.y ? a : b;
    const glm::dvec2& high = a.y < b.y ? b : a;
    // Half open, so that a vertex in the middle of a row counts once.
    const int begin = static_cast<int>(std::ceil(low.y * rowsPerEm - 0.5));
    const int end = static_cast<int>(std::ceil(high.y * rowsPerEm - 0.5));
    for (int row = begin; row < end; ++row)
    {
        const double y = (row + 0.5) / rowsPerEm;
        const double x = low.x + (high.x - low.x) * (y - low.y) / (high.y - low.y);
        rows[static_cast<std::size_t>(row - firstRow)].push_back(
            {static_cast<float>(x), a.y < b.y ? 1 : -1});
    }
}

} // namespace

InkSpans::InkSpans(const GlyphOutline& outline, int rowsPerEm) : _rowsPerEm(rowsPerEm)
{
    const OutlineBounds bounds = getBounds(outline);
    _firstRow = static_cast<int>(std::floor(bounds.low.y * static_cast<float>(rowsPerEm))) - 1;
    const int endRow =
        static_cast<int>(std::ceil(bounds.high.y * static_cast<float>(rowsPerEm))) + 1;
    Rows rows(static_cast<std::size_t>(endRow - _firstRow));
    for (const std::vector<glm::vec2>& contour : outline.contours)
        for (std::size_t i = 0; i < contour.size(); ++i)
            cross(rows, _firstRow, rowsPerEm, contour[i], contour[(i + 1) % contour.size()]);
    for (std::vector<Crossing>& row : rows)
    {
        std::sort(row.begin(), row.end(),
                  [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
        int winding = 0;
        for (const Crossing& crossing : row)
        {
            const bool wasInk = winding != 0;
            winding += crossing.winding;
            if (wasInk != (winding != 0))
                _edges.push_back(crossing.x);
        }
        _begins.push_back(static_cast<std::uint32_t>(_edges.size()));
    }
}

const float* InkSpans::begin(int row) const
{
    const bool isInked = row >= _firstRow && row < getEndRow();
    return _edges.data() + (isInked ? _begins[static_cast<std::size_t>(row - _firstRow)] : 0);
}

const float* InkSpans::end(int row) const
{
    const bool isInked = row >= _firstRow && row < getEndRow();
    return _edges.data() + (isInked ? _begins[static_cast<std::size_t>(row - _firstRow) + 1] : 0);
}

bool InkSpans::contains(float x, float y) const
{
    const int row = static_cast<int>(std::floor(y * static_cast<float>(_rowsPerEm)));
    const float* const first = begin(row);
    return (std::upper_bound(first, end(row), x) - first) & 1;
}

float InkSpans::getInk(int row, float left, float right) const
{
    float ink = 0.0f;
    for (const float* edge = begin(row); edge + 1 < end(row); edge += 2)
        ink += std::max(0.0f, std::min(right, edge[1]) - std::max(left, edge[0]));
    return ink;
}

} // namespace osgLabels
