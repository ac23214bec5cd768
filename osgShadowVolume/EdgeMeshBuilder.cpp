// SPDX-License-Identifier: MIT
#include <osgShadowVolume/EdgeMeshBuilder.h>

#include <osgMultiRender/AllCores.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>
#include <numeric>

namespace osgShadowVolume
{

namespace
{

using Index = std::uint32_t;
constexpr Index None = 0xffffffffu;

/// Below this many elements a second thread costs more than it saves.
constexpr std::size_t ThreadThreshold = 50000;

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isBefore(const glm::vec3& a, const glm::vec3& b)
{
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

std::uint32_t bitsOf(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

std::uint64_t hashOf(const glm::vec3& v)
{
    std::uint64_t hash = bitsOf(v.x) | std::uint64_t(bitsOf(v.y)) << 32;
    hash *= 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    hash = (hash + bitsOf(v.z)) * 0xbf58476d1ce4e5b9u;
    return hash ^ hash >> 29;
}

/// Distinct positions, numbered in the order in which they came.
class Weld
{
public:
    explicit Weld(std::size_t expected) { grow(expected); }

    Index add(const glm::vec3& position)
    {
        if (2 * vertices.size() >= _slots.size())
            grow(_slots.size());
        Index& slot = slotOf(position);
        if (slot == None)
        {
            slot = Index(vertices.size());
            vertices.push_back(position);
        }
        return slot;
    }

    std::vector<glm::vec3> vertices;

private:
    Index& slotOf(const glm::vec3& position)
    {
        std::size_t at = hashOf(position) & (_slots.size() - 1);
        while (_slots[at] != None && vertices[_slots[at]] != position)
            at = (at + 1) & (_slots.size() - 1);
        return _slots[at];
    }

    void grow(std::size_t vertexCount)
    {
        std::size_t size = 16;
        while (size < 2 * vertexCount)
            size *= 2;
        _slots.assign(size, None);
        for (Index i = 0; i != vertices.size(); ++i)
            slotOf(vertices[i]) = i;
    }

    std::vector<Index> _slots; ///< Open addressing; a power of two.
};

/// Sorts, in two threads where that pays.
template <class Iterator, class Less> void sortLarge(Iterator begin, Iterator end, Less less)
{
    if (std::size_t(end - begin) < ThreadThreshold)
    {
        std::sort(begin, end, less);
        return;
    }
    const Iterator middle = begin + (end - begin) / 2;
    auto half = std::async(std::launch::async,
                           [=]
                           {
                               osgMultiRender::useAllCores();
                               std::sort(begin, middle, less);
                           });
    std::sort(middle, end, less);
    half.wait();
    std::inplace_merge(begin, middle, end, less);
}

/// Calls `work(begin, end)` for both halves of [0, count), at the same time where that pays.
template <class Work> void inHalves(Index count, std::size_t cost, const Work& work)
{
    if (cost < ThreadThreshold)
    {
        work(Index(0), count);
        return;
    }
    auto half = std::async(std::launch::async,
                           [&]
                           {
                               osgMultiRender::useAllCores();
                               work(Index(0), count / 2);
                           });
    work(count / 2, count);
    half.wait();
}

/// Puts the vertices in ascending order; returns the new index of each old one.
std::vector<Index> sortVertices(std::vector<glm::vec3>& vertices)
{
    struct Numbered
    {
        glm::vec3 position;
        Index old;
    };
    std::vector<Numbered> sorted(vertices.size());
    for (Index i = 0; i != vertices.size(); ++i)
        sorted[i] = {vertices[i], i};
    sortLarge(sorted.begin(), sorted.end(),
              [](const Numbered& a, const Numbered& b)
              { return isBefore(a.position, b.position); });
    std::vector<Index> ranks(vertices.size());
    for (Index i = 0; i != sorted.size(); ++i)
    {
        vertices[i] = sorted[i].position;
        ranks[sorted[i].old] = i;
    }
    return ranks;
}

glm::uvec3 ascending(glm::uvec3 t)
{
    if (t.x > t.y)
        std::swap(t.x, t.y);
    if (t.y > t.z)
        std::swap(t.y, t.z);
    if (t.x > t.y)
        std::swap(t.x, t.y);
    return t;
}

/// The sides of all triangles, listed by their lower end: `ends[starts[v]]` to `ends[starts[v +
/// 1]]` are those that begin at v, each the upper end and, in the low half, the opposite vertex.
struct SidesByVertex
{
    std::vector<Index> starts;
    std::vector<std::uint64_t> ends;
};

SidesByVertex listSides(const std::vector<glm::uvec3>& triangles, Index vertexCount)
{
    SidesByVertex sides;
    sides.starts.assign(vertexCount + 2, 0);
    for (const glm::uvec3& t : triangles)
    {
        sides.starts[t.x + 2] += 2;
        sides.starts[t.y + 2] += 1;
    }
    std::partial_sum(sides.starts.begin(), sides.starts.end(), sides.starts.begin());
    sides.ends.resize(3 * triangles.size());
    const auto put = [&](Index low, Index high, Index opposite)
    { sides.ends[sides.starts[low + 1]++] = std::uint64_t(high) << 32 | opposite; };
    for (const glm::uvec3& t : triangles)
    {
        put(t.x, t.y, t.z);
        put(t.x, t.z, t.y);
        put(t.y, t.z, t.x);
    }
    inHalves(vertexCount, sides.ends.size(),
             [&](Index begin, Index end)
             {
                 for (Index v = begin; v != end; ++v)
                     std::sort(sides.ends.begin() + sides.starts[v],
                               sides.ends.begin() + sides.starts[v + 1]);
             });
    return sides;
}

using Records = std::vector<Index>[EdgeMesh::MaxOpposites + 1];

/// Writes the records of one edge, all of whose opposite vertices are the low halves of [begin,
/// end).
void addEdge(Records& records, Index low, const std::uint64_t* begin, const std::uint64_t* end)
{
    const Index high = Index(*begin >> 32);
    while (begin != end)
    {
        const std::size_t count = std::min<std::size_t>(end - begin, EdgeMesh::MaxOpposites);
        std::vector<Index>& record = records[std::max<std::size_t>(count, 2)];
        record.push_back(low);
        record.push_back(high);
        for (const std::uint64_t* side = begin; side != begin + count; ++side)
            record.push_back(Index(*side));
        if (count == 1)
            record.push_back(low);
        begin += count;
    }
}

std::vector<EdgeMesh::Group> groupEdges(const SidesByVertex& sides, Index vertexCount)
{
    Records records;
    records[2].reserve(2 * sides.ends.size() + 16);
    for (Index low = 0; low != vertexCount; ++low)
    {
        const std::uint64_t* begin = sides.ends.data() + sides.starts[low];
        const std::uint64_t* const last = sides.ends.data() + sides.starts[low + 1];
        while (begin != last)
        {
            const std::uint64_t* end = begin;
            while (end != last && *end >> 32 == *begin >> 32)
                ++end;
            addEdge(records, low, begin, end);
            begin = end;
        }
    }
    records[2].shrink_to_fit();
    std::vector<EdgeMesh::Group> groups;
    for (std::uint32_t opposites = 2; opposites <= EdgeMesh::MaxOpposites; ++opposites)
        if (!records[opposites].empty())
            groups.push_back({opposites, std::move(records[opposites])});
    return groups;
}

void measure(EdgeMesh& mesh)
{
    if (mesh.vertices.empty())
        return;
    glm::vec3 low = mesh.vertices.front(), high = low;
    for (const glm::vec3& vertex : mesh.vertices)
    {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
    }
    const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
    const double extent = std::max({size.x, size.y, size.z});
    // Within the exponents of normal floats: devices may take smaller ones for 0.
    mesh.scale = float(std::ldexp(1.0, std::clamp(-std::ilogb(extent), -126, 126)));
    const glm::vec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    mesh.reach = std::max({farthest.x, farthest.y, farthest.z});
}

} // namespace

void EdgeMeshBuilder::addTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    if (!isFinite(a) || !isFinite(b) || !isFinite(c))
        ++_notFinite;
    else if (a == b || b == c || c == a)
        ++_degenerate;
    else
        // Adding 0 takes the sign off a zero, so that equal positions are equal bit for bit.
        _corners.insert(_corners.end(), {a + 0.0f, b + 0.0f, c + 0.0f});
}

EdgeMesh EdgeMeshBuilder::build()
{
    EdgeMesh mesh;
    mesh.degenerate = _degenerate;
    mesh.notFinite = _notFinite;
    // Closed meshes have half as many vertices as triangles.
    Weld weld(_corners.size() / 6);
    mesh.triangles.resize(_corners.size() / 3);
    for (std::size_t i = 0; i != mesh.triangles.size(); ++i)
        for (int k = 0; k != 3; ++k)
            mesh.triangles[i][k] = weld.add(_corners[3 * i + k]);
    mesh.vertices = std::move(weld.vertices);
    const std::vector<Index> ranks = sortVertices(mesh.vertices);
    for (glm::uvec3& t : mesh.triangles)
        t = ascending({ranks[t.x], ranks[t.y], ranks[t.z]});
    mesh.vertices.shrink_to_fit();
    const Index vertexCount = Index(mesh.vertices.size());
    mesh.groups = groupEdges(listSides(mesh.triangles, vertexCount), vertexCount);
    measure(mesh);
    *this = EdgeMeshBuilder();
    return mesh;
}

} // namespace osgShadowVolume
