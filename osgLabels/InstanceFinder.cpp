// SPDX-License-Identifier: MIT
#include <osgLabels/InstanceFinder.h>

#include <osg/Transform>

#include <algorithm>

namespace osgLabels
{

namespace
{

const osg::Vec3d direction(0.5023, 0.6469, 0.5737); // of no lattice

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
        _size = extent.length();
        // Off the axes of all symmetries that a box may have, flat ones included.
        _point = osg::Vec3d(box.center()) + osg::Vec3d(0.31, 0.23, 0.41) * _size;
    }
    _places.reserve(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i)
    {
        osg::Matrixd matrix;
        for (std::size_t node = 1; node < paths[i].size(); ++node)
            if (osg::Transform* transform = paths[i][node]->asTransform())
                transform->computeLocalToWorldMatrix(matrix, nullptr);
        const osg::Vec3d point = _point * matrix;
        _places.push_back({point * direction, point, i});
    }
    std::sort(_places.begin(), _places.end(),
              [](const Place& a, const Place& b) { return a.key < b.key; });
}

std::size_t InstanceFinder::find(const osg::Matrixd& localToTop, double roundingError) const
{
    const osg::Vec3d point = _point * localToTop;
    const double key = point * direction;
    const double tolerance = 1e-6 * _size + roundingError;
    double best = tolerance * tolerance;
    std::size_t found = None;
    for (auto place = std::lower_bound(_places.begin(), _places.end(), key - tolerance,
                                       [](const Place&p, double k) { return p.key < k; });
         place != _places.end() && place->key <= key + tolerance; ++place)
        if (const double distance = (place->point - point).length2(); distance <= best)
        {
            best = distance;
            found = place->path;
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
