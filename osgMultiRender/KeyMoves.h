// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyPoints.h>

#include <unordered_map>

namespace osgMultiRender
{

/// Keeps cells in use while a few of many key points move, come and go.
///
/// Free of OSG and GL. Cells take too long to be made in each frame. Those of an earlier frame stay
/// right for the segments that are still there, but where they list one that is gone: these tell
/// nothing any more. Segments that are new are few and looked at one by one.
class OSGMULTIRENDER_EXPORT KeyMoves
{
public:
    static constexpr std::size_t MostLoose = 16; ///< With more new segments there are no cells.
    static constexpr std::size_t MostGone = 64;

    /// Takes the points of the next drawing. Where they are those of the last one they get cells
    /// of their own in time; else those that are there serve them, if they can. 0.5 ms for 10,000.
    void update(const KeyPoints& points);

    /// Null where none serve the points.
    const std::shared_ptr<const KeyCells>& getCells() const { return _cells; }
    /// The segments that the cells' candidates are numbers of, those that are gone included.
    const std::vector<KeySegment>& getListed() const { return _made.getTree().getSegments(); }
    bool isOwn() const { return _loose.empty() && _gone.empty(); } ///< Listed are the points' own.
    const std::vector<KeySegment>& getLoose() const { return _loose; } ///< Listed in no cell.

    /// As a fragment finds it; none where cells do not tell.
    std::optional<double> distance(const glm::dvec3& place) const;

private:
    struct Hash
    {
        std::size_t operator()(const KeySegment& segment) const;
    };
    struct Equal
    {
        bool operator()(const KeySegment& a, const KeySegment& b) const
        {
            return a.first == b.first && a.second == b.second;
        }
    };

    void take(const KeyPoints& points, std::shared_ptr<const KeyCells> cells);
    void compare(const KeyPoints& points);

    std::shared_ptr<const void> _given; ///< The points of the last time.
    KeyPoints _made;                    ///< What cells were made for.
    std::shared_ptr<const KeyCells> _madeCells;
    std::unordered_map<KeySegment, std::uint32_t, Hash, Equal> _numbers; ///< Of the listed.
    std::vector<std::uint32_t> _gone;
    std::vector<KeySegment> _loose;
    std::shared_ptr<const KeyCells> _cells;
};

} // namespace osgMultiRender
