// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyTree.h>

#include <atomic>
#include <optional>

namespace osgMultiRender
{

/// Space around key points in cells that list the segments that can be the nearest one there.
///
/// Free of OSG and GL. A fragment finds its cell by its place and looks at a few segments, without
/// a stack and mostly the same ones as its neighbours. There are two grids of Grid cells an axis:
/// one around the segments, and one that is some six times as wide. Cells with many candidates are
/// halved along all axes. What is farther away, or in a cell that would list too many, is not told.
class OSGMULTIRENDER_EXPORT KeyCells
{
public:
    static constexpr int Grid = 16;
    static constexpr int Levels = 16; ///< A grid is 2^Levels of the smallest cells wide.
    static constexpr std::uint32_t MaxCandidates = 64; ///< In a cell.
    static constexpr std::size_t MaxSegments = std::size_t(1) << 17;

    /// A cube with Grid^3 cells, of which the first is `first`.
    struct Root
    {
        glm::dvec3 low{0.0};
        double size = 0.0; ///< 0: nothing is in it.
        std::int32_t first = 0;
    };

    KeyCells() = default;
    /// Some 100 ms for 10,000 points, up to a second for as many lines. With more than MaxSegments,
    /// or none, nothing is told.
    /// Ends soon, with any result, when `isLeft` becomes true.
    explicit KeyCells(const std::vector<KeySegment>& segments,
                      const std::atomic<bool>* isLeft = nullptr);

    /// The distance of the nearest segment of the point's cell; none where that is not told.
    std::optional<double> distance(const glm::dvec3& point) const;

    /// These without what lists one of some segments: there nothing is told.
    KeyCells without(const std::vector<std::uint32_t>& segments) const;

    const std::array<Root, 2>& getRoots() const { return _roots; } ///< The inner one first.
    /// Cells, x fastest, and lists. A cell is 0 where nothing is told, the index of the first of
    /// its eight parts, or -1 - (16 * its list + the fours of the list - 1). Candidates are indices
    /// of segments, in fours: list n begins at 4 n, and the last one is there until its four is
    /// full.
    const std::vector<std::int32_t>& getCells() const { return _cells; }

private:
    void dropLists(std::int32_t first, int count, const std::vector<bool>& isGone);

    std::vector<KeySegment> _segments;
    std::array<Root, 2> _roots;
    std::vector<std::int32_t> _cells;
};

} // namespace osgMultiRender
