// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphOutline.h>

#include <vector>

namespace osgLabels
{

/// Integrals of a glyph's ink over rectangles, by sums over all that is below and left of a point.
class BoxSums
{
public:
    BoxSums(const GlyphOutline& outline, int cellsPerEm);

    /// Share of ink in the square of that side, in em, about a point.
    float getShare(const glm::vec2& center, float side) const;

    /// All ink, in square em.
    double getTotal() const { return _sums.back(); }

private:
    double getSum(double x, double y) const;

    int _cellsPerEm;
    int _left = 0, _bottom = 0, _width = 0, _height = 0; ///< Cells.
    std::vector<double> _sums;                           ///< (width + 1) x (height + 1)
};

} // namespace osgLabels
