// SPDX-License-Identifier: MIT
#include <osgLabels/MeshSides.h>

#include <osgLabels/PrimitiveRun.h>

#include <osg/Geometry>
#include <osg/TriangleFunctor>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace osgLabels
{

namespace
{

struct PlaceHash
{
    std::size_t operator()(const osg::Vec3& v) const
    {
        std::uint32_t words[3];
        std::memcpy(words, v.ptr(), sizeof words);
        std::uint64_t hash = 0;
        for (const std::uint32_t word : words)
            hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        return std::size_t(hash ^ hash >> 32);
    }
};

std::uint64_t edgeOf(std::uint32_t from, std::uint32_t to)
{
    const bool turned = to < from;
    return std::uint64_t(turned ? to : from) << 33 | std::uint64_t(turned ? from : to) << 1 |
           std::uint64_t(turned);
}

/// Numbers corners by their place, and keeps directed edges and the volume.
struct ReadEdges
{
    std::unordered_map<osg::Vec3, std::uint32_t, PlaceHash> corners;
    std::vector<std::uint64_t> edges; ///< The smaller corner first; the last bit is the direction.
    osg::Vec3d first;
    double volume = 0.0; ///< Six times.
    bool isFinite = true;

    std::uint32_t cornerOf(osg::Vec3 v)
    {
        for (int i = 0; i < 3; ++i)
            v[i] += 0.0f; // no negative zero
        return corners.emplace(v, std::uint32_t(corners.size())).first->second;
    }
    void addEdge(std::uint32_t from, std::uint32_t to)
    {
        const bool turned = to < from;
        edges.push_back(
            (std::uint64_t(turned ? to : from) << 33 | std::uint64_t(turned ? from : to) << 1) |
            std::uint64_t(turned));
    }
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false)
    {
        if (!a.valid() || !b.valid() || !c.valid())
        {
            isFinite = false;
            return;
        }
        const std::uint32_t i = cornerOf(a), j = cornerOf(b), k = cornerOf(c);
        if (i == j || j == k || k == i)
            return;
        if (edges.empty())
            first = a;
        volume += (osg::Vec3d(a) - first) * ((osg::Vec3d(b) - first) ^ (osg::Vec3d(c) - first));
        addEdge(i, j);
        addEdge(j, k);
        addEdge(k, i);
    }
};

bool isClosed(std::vector<std::uint64_t>& edges)
{
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end)
    {
        std::size_t turned = 0;
        for (end = i; end < edges.size() && edges[end] >> 1 == edges[i] >> 1; ++end)
            turned += edges[end] & 1u;
        if (2 * turned != end - i)
            return false;
    }
    return !edges.empty();
}

/// For each corner another one at the same place but for rounding, as at the seams of round
/// shapes, or itself.
class Weld
{
public:
    explicit Weld(const std::vector<osg::Vec3>& corners)
    {
        osg::BoundingBox box;
        for (const osg::Vec3& corner : corners)
            box.expandBy(corner);
        // Four last bits of the largest coordinate, or of the mesh's size times 2^-20.
        float largest = 0.0f;
        for (int i = 0; i < 3; ++i)
            largest = std::max({largest, std::abs(box._min[i]), std::abs(box._max[i])});
        _tolerance = std::max(largest * 0x1p-22f, 2.0f * box.radius() * 0x1p-20f);
        for (const osg::Vec3& corner : corners)
            _partners.push_back(find(corner));
    }
    std::uint32_t operator[](std::uint32_t corner) const { return _partners[corner]; }

private:
    osg::Vec3 cellOf(const osg::Vec3& v) const
    {
        const float size = 4.0f * _tolerance;
        return {std::floor(v.x() / size), std::floor(v.y() / size), std::floor(v.z() / size)};
    }
    std::uint32_t find(const osg::Vec3& v)
    {
        for (unsigned int side = 0; side < 8; ++side)
        {
            osg::Vec3 moved = v;
            for (int i = 0; i < 3; ++i)
                moved[i] += side >> i & 1u ? _tolerance : -_tolerance;
            const auto cell = _cells.find(cellOf(moved));
            if (cell != _cells.end() && (cell->second.first - v).length() <= _tolerance)
                return cell->second.second;
        }
        const auto number = std::uint32_t(_partners.size());
        _cells.emplace(cellOf(v), std::make_pair(v, number));
        return number;
    }

    float _tolerance = 0.0f;
    std::unordered_map<osg::Vec3, std::pair<osg::Vec3, std::uint32_t>, PlaceHash> _cells;
    std::vector<std::uint32_t> _partners;
};

bool isClosed(const ReadEdges& read)
{
    std::vector<std::uint64_t> edges = read.edges;
    if (isClosed(edges))
        return true;
    std::vector<osg::Vec3> corners(read.corners.size());
    for (const auto& [place, number] : read.corners)
        corners[number] = place;
    const Weld weld(corners);
    edges.clear();
    for (const std::uint64_t edge : read.edges)
    {
        const std::uint32_t low = weld[std::uint32_t(edge >> 33)],
                            high = weld[std::uint32_t(edge >> 1)];
        if (low != high)
            edges.push_back(edge & 1u ? edgeOf(high, low) : edgeOf(low, high));
    }
    return isClosed(edges);
}

} // namespace

MeshSides sidesOf(const osg::Drawable& drawable)
{
    if (auto* run = dynamic_cast<const PrimitiveRun*>(&drawable))
        return run->getShape() == Shape::Quad ? MeshSides::Open : MeshSides::Outward;
    osg::TriangleFunctor<ReadEdges> functor;
    if (!drawable.supports(functor))
        return MeshSides::Open;
    drawable.accept(functor);
    if (!functor.isFinite || !isClosed(static_cast<const ReadEdges&>(functor)) ||
        functor.volume == 0.0)
        return MeshSides::Open;
    return functor.volume > 0.0 ? MeshSides::Outward : MeshSides::Inward;
}

std::uint64_t stampOf(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry)
        return 0;
    std::uint64_t stamp = 1;
    const auto mix = [&stamp](std::uint64_t value)
    {
        stamp = (stamp ^ value) * 0x9E3779B97F4A7C15u;
        stamp ^= stamp >> 32;
    };
    const auto add = [&mix](const osg::BufferData* data, unsigned int size)
    {
        mix(reinterpret_cast<std::uintptr_t>(data));
        mix(std::uint64_t(data->getModifiedCount()) << 32 | size);
    };
    if (const osg::Array* vertices = geometry->getVertexArray())
        add(vertices, vertices->getNumElements());
    for (const osg::ref_ptr<osg::PrimitiveSet>& set : geometry->getPrimitiveSetList())
        add(set.get(), set->getNumIndices());
    return stamp;
}

} // namespace osgLabels
