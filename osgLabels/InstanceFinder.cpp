// SPDX-License-Identifier: MIT
#include <osgLabels/InstanceFinder.h>

#include <osg/Transform>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace osgLabels
{

namespace
{

void addPaths(const osg::Node& top, const osg::Node& node, osg::NodePath& below, std::size_t most,
              std::vector<osg::NodePath>& paths)
{
    below.push_back(const_cast<osg::Node*>(&node));
    if (&node == &top)
        paths.emplace_back(below.rbegin(), below.rend());
    else
        for (unsigned int i = 0; i < node.getNumParents() && paths.size() < most; ++i)
            addPaths(top, *node.getParent(i), below, most, paths);
    below.pop_back();
}

} // namespace

std::vector<osg::NodePath> pathsFrom(const osg::Node& top, const osg::Node& node, std::size_t most)
{
    std::vector<osg::NodePath> paths;
    osg::NodePath below;
    addPaths(top, node, below, most, paths);
    return paths;
}

std::uint64_t hashOf(const osg::NodePath& path, std::size_t count)
{
    std::uint64_t hash = count;
    for (std::size_t i = 0; i < count; ++i)
    {
        hash = (hash ^ reinterpret_cast<std::uintptr_t>(path[i])) * 0xD6E8FEB86659FD93u;
        hash ^= hash >> 32;
    }
    return hash;
}

InstanceFinder::InstanceFinder(const osg::BoundingBox& box, const std::vector<osg::NodePath>& paths)
{
    if (box.valid())
    {
        const osg::Vec3d extent = osg::Vec3d(box._max) - osg::Vec3d(box._min);
        _size = std::max(extent.length(), 1e-30);
        // Off the axes of all symmetries that a box may have, flat ones included.
        _point = osg::Vec3d(box.center()) + osg::Vec3d(0.31, 0.23, 0.41) * _size;
    }
    std::size_t buckets = 1;
    while (buckets < paths.size())
        buckets *= 2;
    _buckets.assign(buckets + 1, 0);

    std::vector<Place> places;
    places.reserve(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i)
    {
        osg::Matrixd matrix;
        for (std::size_t node = 1; node < paths[i].size(); ++node)
            if (osg::Transform* transform = paths[i][node]->asTransform())
                transform->computeLocalToWorldMatrix(matrix, nullptr);
        places.push_back({_point * matrix, i});
        ++_buckets[bucketOf(cellOf(places.back().point)) + 1];
    }
    std::partial_sum(_buckets.begin(), _buckets.end(), _buckets.begin());
    std::vector<std::uint32_t> next(_buckets.begin(), _buckets.end() - 1);
    _places.resize(places.size());
    for (const Place& place : places)
        _places[next[bucketOf(cellOf(place.point))]++] = place;
}

osg::Vec3d InstanceFinder::cellOf(const osg::Vec3d& point) const
{
    return {std::floor(point.x() / _size), std::floor(point.y() / _size),
            std::floor(point.z() / _size)};
}

std::size_t InstanceFinder::bucketOf(const osg::Vec3d& cell) const
{
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        std::uint64_t bits;
        const double coordinate = cell[axis] + 0.0; // -0 is 0
        std::memcpy(&bits, &coordinate, sizeof bits);
        hash = (hash ^ bits) * 0xD6E8FEB86659FD93u;
        hash ^= hash >> 32;
    }
    return hash & (_buckets.size() - 2);
}

std::size_t InstanceFinder::find(const osg::Matrixd& localToTop, double roundingError) const
{
    const osg::Vec3d point = _point * localToTop;
    const double tolerance = 1e-6 * _size + roundingError;
    if (_places.empty() || !(tolerance < _size))
        return None;
    const osg::Vec3d margin(tolerance, tolerance, tolerance);
    const osg::Vec3d first = cellOf(point - margin), last = cellOf(point + margin);
    double best = tolerance * tolerance;
    std::size_t found = None;
    for (double x = first.x(); x <= last.x(); x += 1.0)
        for (double y = first.y(); y <= last.y(); y += 1.0)
            for (double z = first.z(); z <= last.z(); z += 1.0)
            {
                const std::size_t bucket = bucketOf({x, y, z});
                for (std::uint32_t i = _buckets[bucket]; i < _buckets[bucket + 1]; ++i)
                    if (const double distance = (_places[i].point - point).length2();
                        distance <= best)
                    {
                        best = distance;
                        found = _places[i].path;
                    }
            }
    return found;
}

std::size_t InstanceFinder::findNearest(const osg::Matrixd& localToTop) const
{
    const osg::Vec3d point = _point * localToTop;
    const auto nearest =
        std::min_element(_places.begin(), _places.end(),
                         [&](const Place& a, const Place& b)
                         { return (a.point - point).length2() < (b.point - point).length2(); });
    return nearest == _places.end() ? None : nearest->path;
}

} // namespace osgLabels
