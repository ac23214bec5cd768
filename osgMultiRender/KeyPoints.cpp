// SPDX-License-Identifier: MIT
#include <osgMultiRender/KeyPoints.h>

#include <osgMultiRender/AllCores.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <mutex>
#include <utility>

namespace osgMultiRender
{

namespace
{

/// False for what is not a number.
bool isWithin(const glm::dvec3& position, double limit)
{
    return std::abs(position.x) <= limit && std::abs(position.y) <= limit &&
           std::abs(position.z) <= limit;
}

/// Of a polyline only pieces that have a length, unless there is none.
std::vector<KeySegment> join(const std::vector<glm::dvec3>& points, KeyMode mode)
{
    std::vector<KeySegment> segments;
    segments.reserve(points.size());
    const auto add = [&](const glm::dvec3& first, const glm::dvec3& second)
    {
        if (first != second)
            segments.push_back({first, second});
    };
    if (mode != KeyMode::Points)
        for (std::size_t i = 1; i < points.size(); ++i)
            add(points[i - 1], points[i]);
    if (mode == KeyMode::PolylineLoop && points.size() > 2)
        add(points.back(), points.front());
    if (segments.empty())
        for (const glm::dvec3& point : points)
            segments.push_back({point, point});
    return segments;
}

} // namespace

struct KeyPoints::Making
{
    ~Making() { isLeft = true; } // the future waits for its thread

    std::atomic<bool> isLeft{false};
    std::mutex mutex;
    std::shared_ptr<const KeyCells> cells;
    std::future<std::shared_ptr<const KeyCells>> future;
};

KeyPoints::KeyPoints(const std::vector<glm::dvec3>& positions, KeyMode mode) : _mode(mode)
{
    std::vector<glm::dvec3> points;
    points.reserve(positions.size());
    for (const glm::dvec3& position : positions)
        if (points.size() < MaxPoints && isWithin(position, MaxCoordinate))
            points.push_back(position);
    _count = points.size();
    _leftOut = positions.size() - points.size();
    _tree = KeyTree(join(points, mode));
    const std::size_t segments = _tree.getSegments().size();
    if (segments > KeyTree::LeafSize && segments <= KeyCells::MaxSegments)
        _making = std::make_shared<Making>();
}

std::shared_ptr<const KeyCells> KeyPoints::findCells(bool waits) const
{
    if (!_making)
        return nullptr;
    std::lock_guard<std::mutex> lock(_making->mutex);
    if (_making->cells)
        return _making->cells;
    auto& future = _making->future;
    if (!future.valid())
        future = std::async(std::launch::async,
                            [segments = _tree.getSegments(), isLeft = &_making->isLeft]
                            {
                                useAllCores();
                                return std::make_shared<const KeyCells>(segments, isLeft);
                            });
    if (waits || future.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        _making->cells = future.get();
    return _making->cells;
}

double KeyPoints::distance(const glm::dvec3& position) const
{
    return isWithin(position, MaxCoordinate) ? _tree.distance(position)
                                             : std::numeric_limits<double>::infinity();
}

} // namespace osgMultiRender
