// SPDX-License-Identifier: MIT
#include <osgLabels/MeshSides.h>

#include <osgLabels/PrimitiveRun.h>

#include <osg/Geometry>
#include <osg/TriangleFunctor>

#include <algorithm>
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

} // namespace

MeshSides sidesOf(const osg::Drawable& drawable)
{
    if (auto* run = dynamic_cast<const PrimitiveRun*>(&drawable))
        return run->getShape() == Shape::Quad ? MeshSides::Open : MeshSides::Outward;
    osg::TriangleFunctor<ReadEdges> functor;
    if (!drawable.supports(functor))
        return MeshSides::Open;
    drawable.accept(functor);
    if (!functor.isFinite || !isClosed(functor.edges) || functor.volume == 0.0)
        return MeshSides::Open;
    return functor.volume > 0.0 ? MeshSides::Outward : MeshSides::Inward;
}

} // namespace osgLabels
