// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphOutline.h>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// A glyph's ink in thin rows: exact in x, sampled in y at the middle of each row.
///
/// What the images of a glyph and the truth that they are measured against are both made of.
class OSGLABELS_EXPORT InkSpans
{
public:
    InkSpans() = default;
    InkSpans(const GlyphOutline& outline, int rowsPerEm);

    int getRowsPerEm() const { return _rowsPerEm; }

    /// The rows that have ink: row i is about y = (i + 0.5) / rowsPerEm.
    int getFirstRow() const { return _firstRow; }
    int getEndRow() const { return _firstRow + static_cast<int>(_begins.size()) - 1; }

    /// Whether there is ink at the point, in em.
    bool contains(float x, float y) const;

    /// Length of the row's ink between two places, in em.
    float getInk(int row, float left, float right) const;

    /// The row's ink: left, right, left, right, … ascending. Empty outside the rows with ink.
    const float* begin(int row) const;
    const float* end(int row) const;

private:
    int _rowsPerEm = 1;
    int _firstRow = 0;
    std::vector<std::uint32_t> _begins{0}; ///< Of the rows in _edges, one more than rows.
    std::vector<float> _edges;
};

} // namespace osgLabels
