// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyCells.h>
#include <osgMultiRender/KeyTree.h>

#include <memory>

namespace osgMultiRender
{

/// What lies between key points.
enum class KeyMode
{
    Points,      ///< Nothing: the distance is that to the nearest point.
    Polyline,    ///< Each is joined with the next one.
    PolylineLoop ///< The last one is joined with the first one, too.
};

/// Any number of points from which the mix of renderings is measured.
///
/// Free of OSG and GL; distances are Euclidean, in the units and the frame of the positions.
///  - Positions with a coordinate that is not a number or beyond MaxCoordinate count as absent; a
///    polyline joins their neighbours. So do positions from number MaxPoints on.
///  - Equal points, and a polyline or loop of one point, measure like that point.
///  - A loop of two points is the segment between them.
///  - Without any point every distance is infinite.
class OSGMULTIRENDER_EXPORT KeyPoints
{
public:
    static constexpr std::size_t MaxPoints = std::size_t(1) << 20;
    static constexpr double MaxCoordinate = 1e15; ///< Its squares stay finite in single precision.

    KeyPoints() = default;
    explicit KeyPoints(const std::vector<glm::dvec3>& positions, KeyMode mode = KeyMode::Points);

    /// Distance to the nearest point or segment: 0 or more; infinity without points, for a
    /// position that is not a number, and for one beyond MaxCoordinate. Some microseconds for
    /// 10,000 points. Callable from any thread.
    double distance(const glm::dvec3& position) const;

    KeyMode getMode() const { return _mode; }
    std::size_t getNumPoints() const { return _count; }    ///< Those that count.
    std::size_t getNumLeftOut() const { return _leftOut; } ///< Those that count as absent.
    const KeyTree& getTree() const { return _tree; }

    /// The cells of these points, which copies share. They are begun in a thread of their own when
    /// they are first asked for; null until they are there, unless `waits`, and for points that
    /// have none. Callable from any thread.
    std::shared_ptr<const KeyCells> findCells(bool waits = false) const;
    /// The same for copies, another one for all other points.
    std::shared_ptr<const void> getIdentity() const { return _making; }

private:
    KeyMode _mode = KeyMode::Points;
    std::size_t _count = 0;
    std::size_t _leftOut = 0;
    KeyTree _tree;
    struct Making;
    std::shared_ptr<Making> _making; ///< Null where one leaf of the tree is all.
};

} // namespace osgMultiRender
