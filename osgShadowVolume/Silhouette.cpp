// SPDX-License-Identifier: MIT
#include <osgShadowVolume/Silhouette.h>

#include <osgMultiRender/AllCores.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <future>
#include <thread>

#ifdef __FAST_MATH__
#error "Silhouettes leak where arithmetic may be rearranged: compile without -ffast-math."
#endif

namespace osgShadowVolume
{

namespace
{

/// Judgements that a thread must have to be worth starting.
constexpr std::size_t JudgementsPerThread = 40000;

using Weighted = std::array<std::vector<std::uint32_t>, EdgeMesh::MaxOpposites + 1>;

/// What one thread found, in the order of records and triangles.
struct Part
{
    Weighted sides; ///< By weight.
    std::vector<std::uint32_t> nearCaps;
    std::vector<std::uint32_t> farCaps;
};

void addSide(std::vector<std::uint32_t>& indices, std::uint32_t from, std::uint32_t to,
             std::uint32_t vertexCount, bool endsInAPoint)
{
    indices.insert(indices.end(), {to, from, from + vertexCount});
    if (!endsInAPoint)
        indices.insert(indices.end(), {to, from + vertexCount, to + vertexCount});
}

void findSides(const EdgeMesh& mesh, const EdgeMesh::Group& group, std::size_t begin,
               std::size_t end, const MeshLight& light, Weighted& sides)
{
    const std::uint32_t vertexCount = std::uint32_t(mesh.vertices.size());
    const std::size_t size = 2 + group.opposites;
    for (std::size_t i = begin; i != end; ++i)
    {
        const std::uint32_t* record = group.indices.data() + i * size;
        const int count = multiplicity(mesh, record, group.opposites, light);
        if (count > 0)
            addSide(sides[count], record[0], record[1], vertexCount, light.endsInAPoint());
        else if (count < 0)
            addSide(sides[-count], record[1], record[0], vertexCount, light.endsInAPoint());
    }
}

void findCaps(const EdgeMesh& mesh, std::size_t begin, std::size_t end, const MeshLight& light,
              Part& part)
{
    const std::uint32_t vertexCount = std::uint32_t(mesh.vertices.size());
    for (std::size_t i = begin; i != end; ++i)
    {
        glm::uvec3 t = mesh.triangles[i];
        const int side =
            facing(mesh.vertices[t.x], mesh.vertices[t.y], mesh.vertices[t.z], light, mesh.scale);
        if (side == 0)
            continue;
        if (side < 0)
            std::swap(t.y, t.z);
        part.nearCaps.insert(part.nearCaps.end(), {t.x, t.y, t.z});
        if (!light.endsInAPoint())
            part.farCaps.insert(part.farCaps.end(),
                                {t.z + vertexCount, t.y + vertexCount, t.x + vertexCount});
    }
}

/// The `number`-th of `parts` equal parts of each list of the mesh.
Part findPart(const EdgeMesh& mesh, const MeshLight& light, std::size_t number, std::size_t parts,
              std::size_t groupNumber)
{
    Part part;
    const auto from = [=](std::size_t count, std::size_t n) { return count * n / parts; };
    if (groupNumber == mesh.groups.size())
    {
        const std::size_t count = mesh.triangles.size();
        findCaps(mesh, from(count, number), from(count, number + 1), light, part);
        return part;
    }
    const EdgeMesh::Group& group = mesh.groups[groupNumber];
    const std::size_t count = group.indices.size() / (2 + group.opposites);
    findSides(mesh, group, from(count, number), from(count, number + 1), light, part.sides);
    return part;
}

void append(std::vector<std::uint32_t>& list, std::vector<std::uint32_t>& more)
{
    if (list.empty())
        list.swap(more);
    else
        list.insert(list.end(), more.begin(), more.end());
}

std::size_t countParts(const EdgeMesh& mesh, unsigned int threads)
{
    if (threads == 0)
        threads = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t worthwhile = 1 + 4 * mesh.triangles.size() / JudgementsPerThread;
    return std::min<std::size_t>(threads, worthwhile);
}

} // namespace

MeshLight toMeshLight(const EdgeMesh& mesh, const glm::dvec4& light)
{
    const double size = std::max(
        {std::abs(light.x), std::abs(light.y), std::abs(light.z), std::abs(light.w) * mesh.reach});
    if (!(size > 0.0) || !std::isfinite(size))
        return {glm::vec4(light), glm::vec3(0.0f)};
    const glm::dvec4 scaled = light * std::ldexp(1.0, -std::ilogb(size));
    const glm::vec4 rounded(scaled);
    return {rounded, glm::vec3(glm::dvec3(scaled) - glm::dvec3(rounded))};
}

int facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const MeshLight& light,
           float scale)
{
    const float ux = (c.x - a.x) * scale;
    const float uy = (c.y - a.y) * scale;
    const float uz = (c.z - a.z) * scale;
    const float vx = (light.light.x - a.x * light.light.w) + light.rest.x;
    const float vy = (light.light.y - a.y * light.light.w) + light.rest.y;
    const float vz = (light.light.z - a.z * light.light.w) + light.rest.z;
    const float nx = uy * vz - uz * vy;
    const float ny = uz * vx - ux * vz;
    const float nz = ux * vy - uy * vx;
    const float side =
        nx * ((b.x - a.x) * scale) + ny * ((b.y - a.y) * scale) + nz * ((b.z - a.z) * scale);
    return side > 0.0f ? 1 : side < 0.0f ? -1 : 0;
}

int multiplicity(const EdgeMesh& mesh, const std::uint32_t* record, std::uint32_t opposites,
                 const MeshLight& light)
{
    const std::uint32_t low = record[0], high = record[1];
    const glm::vec3& a = mesh.vertices[low];
    const glm::vec3& b = mesh.vertices[high];
    int sum = 0;
    for (std::uint32_t i = 0; i != opposites; ++i)
    {
        const std::uint32_t opposite = record[2 + i];
        const glm::vec3& o = mesh.vertices[opposite];
        if (opposite < low)
            sum += facing(o, a, b, light, mesh.scale);
        else if (opposite > high)
            sum += facing(a, b, o, light, mesh.scale);
        else if (opposite != low && opposite != high)
            sum -= facing(a, o, b, light, mesh.scale);
    }
    return sum;
}

Silhouette silhouetteOf(const EdgeMesh& mesh, const MeshLight& light, unsigned int threads)
{
    const std::size_t parts = countParts(mesh, threads);
    Weighted sides;
    Silhouette silhouette;
    const auto findAll = [&](std::size_t number)
    {
        std::vector<Part> lists;
        for (std::size_t group = 0; group <= mesh.groups.size(); ++group)
            lists.push_back(findPart(mesh, light, number, parts, group));
        return lists;
    };
    std::vector<std::future<std::vector<Part>>> others;
    for (std::size_t number = 1; number < parts; ++number)
        others.push_back(std::async(std::launch::async,
                                    [&findAll, number]
                                    {
                                        osgMultiRender::useAllCores();
                                        return findAll(number);
                                    }));
    std::vector<std::vector<Part>> found{findAll(0)};
    for (auto& other : others)
        found.push_back(other.get());
    // Group by group, so that the order is that of the mesh whatever the number of parts.
    for (std::size_t group = 0; group <= mesh.groups.size(); ++group)
        for (std::vector<Part>& lists : found)
        {
            for (std::size_t weight = 1; weight != sides.size(); ++weight)
                append(sides[weight], lists[group].sides[weight]);
            append(silhouette.nearCaps, lists[group].nearCaps);
            append(silhouette.farCaps, lists[group].farCaps);
        }
    for (std::size_t weight = 1; weight != sides.size(); ++weight)
        if (!sides[weight].empty())
            silhouette.sides.push_back({std::uint32_t(weight), std::move(sides[weight])});
    return silhouette;
}

} // namespace osgShadowVolume
