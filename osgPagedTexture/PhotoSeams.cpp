// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoSeams.h>

#include <osgPagedTexture/PlaceWelder.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace osgPagedTexture
{

namespace
{

/// An edge of a triangle; `low` and `high` are its ends, welded.
struct Edge
{
    std::uint32_t low, high;
    std::uint32_t photo, surface;
    std::size_t lowCorner, highCorner; ///< Of the surface.

    auto key() const { return std::tie(low, high, photo); }
    bool operator<(const Edge& other) const
    {
        return std::tie(low, high, photo, surface, lowCorner) <
               std::tie(other.low, other.high, other.photo, other.surface, other.lowCorner);
    }
};

double standardTolerance(const std::vector<Photo>& photos)
{
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const Photo& photo : photos)
    {
        for (const PhotoSurface& surface : photo.surfaces)
        {
            for (const glm::dvec3& place : surface.places)
            {
                low = glm::min(low, place);
                high = glm::max(high, place);
            }
        }
    }
    return low.x <= high.x ? 1e-7 * glm::distance(low, high) : 0.0;
}

std::vector<Edge> collectEdges(const std::vector<Photo>& photos, double tolerance)
{
    PlaceWelder welder(tolerance);
    std::vector<Edge> edges;
    for (std::size_t photo = 0; photo < photos.size(); ++photo)
    {
        for (std::size_t number = 0; number < photos[photo].surfaces.size(); ++number)
        {
            const PhotoSurface& surface = photos[photo].surfaces[number];
            for (std::size_t first = 0; first + 2 < surface.places.size(); first += 3)
            {
                std::uint32_t welded[3];
                for (std::size_t i = 0; i < 3; ++i)
                    welded[i] = welder.add(surface.places[first + i]);
                for (std::size_t i = 0; i < 3; ++i)
                {
                    const std::size_t j = (i + 1) % 3;
                    if (welded[i] == welded[j])
                        continue; // No length.
                    const std::size_t low = welded[i] < welded[j] ? i : j, high = i + j - low;
                    edges.push_back({welded[low], welded[high], std::uint32_t(photo),
                                     std::uint32_t(number), first + low, first + high});
                }
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

PhotoSeam::Side sideOf(const std::vector<Photo>& photos, const Edge& edge)
{
    const PhotoSurface& surface = photos[edge.photo].surfaces[edge.surface];
    return {edge.photo, edge.surface, surface.coordinates[edge.lowCorner],
            surface.coordinates[edge.highCorner]};
}

PhotoSeam seamOf(const std::vector<Photo>& photos, const Edge& a, const Edge& b)
{
    PhotoSeam seam;
    seam.sides = {sideOf(photos, a), sideOf(photos, b)};
    const PhotoSurface& surface = photos[a.photo].surfaces[a.surface];
    seam.from = surface.places[a.lowCorner];
    seam.to = surface.places[a.highCorner];
    seam.length = glm::distance(seam.from, seam.to);
    return seam;
}

} // namespace

std::vector<PhotoSeam> findSeams(const std::vector<Photo>& photos, double tolerance)
{
    const std::vector<Edge> edges =
        collectEdges(photos, tolerance < 0.0 ? standardTolerance(photos) : tolerance);
    std::vector<PhotoSeam> seams;
    for (std::size_t begin = 0; begin < edges.size();)
    {
        // One edge of each photograph stands for all of it that lie there.
        std::vector<std::size_t> firsts;
        std::size_t end = begin;
        for (; end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high;
             ++end)
            if (end == begin || edges[end].photo != edges[end - 1].photo)
                firsts.push_back(end);
        for (std::size_t i = 0; i < firsts.size(); ++i)
            for (std::size_t j = i + 1; j < firsts.size(); ++j)
                seams.push_back(seamOf(photos, edges[firsts[i]], edges[firsts[j]]));
        begin = end;
    }
    return seams;
}

std::vector<std::vector<PhotoNeighbour>> findNeighbours(const std::vector<Photo>& photos,
                                                        const std::vector<PhotoSeam>& seams)
{
    std::vector<std::map<std::size_t, PhotoNeighbour>> found(photos.size());
    for (const PhotoSeam& seam : seams)
    {
        for (std::size_t side = 0; side < 2; ++side)
        {
            const PhotoSeam::Side& own = seam.sides[side];
            const Photo& photo = photos[own.photo];
            PhotoNeighbour& neighbour = found[own.photo][seam.sides[1 - side].photo];
            neighbour.photo = seam.sides[1 - side].photo;
            neighbour.length += seam.length;
            neighbour.pixels +=
                glm::length(glm::dvec2(own.to - own.from) * glm::dvec2(photo.width, photo.height));
            ++neighbour.edges;
        }
    }
    std::vector<std::vector<PhotoNeighbour>> neighbours(photos.size());
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        for (const auto& [photo, neighbour] : found[i])
            neighbours[i].push_back(neighbour);
        std::stable_sort(neighbours[i].begin(), neighbours[i].end(),
                         [](const PhotoNeighbour& a, const PhotoNeighbour& b)
                         { return a.length > b.length; });
    }
    return neighbours;
}

} // namespace osgPagedTexture
