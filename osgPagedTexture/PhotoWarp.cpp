// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoWarp.h>

#include <osgPagedTexture/SeamSamples.h>
#include <osgPagedTexture/WrapCells.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgPagedTexture
{

namespace
{

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

class Warp
{
public:
    Warp(const Pixels& source, int width, int height)
        : layer(width, height, 4), _source(source),
          _depths(std::size_t(width) * std::size_t(height), std::numeric_limits<float>::infinity())
    {
    }

    struct Corner
    {
        glm::dvec2 pixel;      ///< Of the layer.
        double w;              ///< Distance.
        glm::dvec2 coordinate; ///< Of the source's texture.
    };

    void draw(const std::array<Corner, 3>& corners, const PhotoSurface& surface)
    {
        const double area =
            cross(corners[1].pixel - corners[0].pixel, corners[2].pixel - corners[0].pixel);
        if (!(std::abs(area) > 0.0) || !std::isfinite(area))
            return;
        glm::dvec2 low = corners[0].pixel, high = low;
        for (const Corner& corner : corners)
        {
            low = glm::min(low, corner.pixel);
            high = glm::max(high, corner.pixel);
        }
        low = glm::clamp(glm::floor(low), glm::dvec2(0.0), size());
        high = glm::clamp(glm::ceil(high), glm::dvec2(0.0), size());
        for (int y = int(low.y); y < int(high.y); ++y)
            for (int x = int(low.x); x < int(high.x); ++x)
                drawPixel(corners, surface, area, x, y);
    }

    Pixels layer;

private:
    glm::dvec2 size() const { return {layer.width, layer.height}; }

    void drawPixel(const std::array<Corner, 3>& corners, const PhotoSurface& surface, double area,
                   int x, int y)
    {
        const glm::dvec2 middle(x + 0.5, y + 0.5);
        glm::dvec2 coordinate(0.0);
        double inverse = 0.0; // Of w, which is what changes evenly over a picture.
        for (std::size_t i = 0; i < 3; ++i)
        {
            const Corner& from = corners[(i + 1) % 3];
            const Corner& to = corners[(i + 2) % 3];
            const double share = cross(to.pixel - from.pixel, middle - from.pixel) / area;
            if (share < 0.0)
                return;
            inverse += share / corners[i].w;
            coordinate += share / corners[i].w * corners[i].coordinate;
        }
        float& depth = _depths[std::size_t(y) * std::size_t(layer.width) + std::size_t(x)];
        if (float(1.0 / inverse) >= depth)
            return;
        depth = float(1.0 / inverse);
        const glm::dvec2 place =
            placeInPhoto(coordinate / inverse, surface, {_source.width, _source.height});
        const glm::vec3 color = lookUp(_source, place);
        std::uint8_t* pixel = layer.row(y) + std::ptrdiff_t(x) * 4;
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = static_cast<std::uint8_t>(color[channel] + 0.5f);
        pixel[3] = 255;
    }

    const Pixels& _source;
    std::vector<float> _depths;
};

} // namespace

Pixels warpPhoto(const Photo& photo, const Pixels& pixels, const PhotoCamera& camera, int width,
                 int height)
{
    Warp warp(pixels, width, height);
    for (const PhotoSurface& surface : photo.surfaces)
    {
        for (std::size_t first = 0; first + 2 < surface.places.size(); first += 3)
        {
            std::array<Warp::Corner, 3> corners;
            bool before = true;
            for (std::size_t i = 0; i < 3; ++i)
            {
                const glm::dvec3 seen = camera.project(surface.places[first + i]);
                before = before && seen.z > 0.0;
                corners[i] = {glm::dvec2(seen) / seen.z, seen.z,
                              glm::dvec2(surface.coordinates[first + i])};
            }
            if (before)
                warp.draw(corners, surface);
        }
    }
    return std::move(warp.layer);
}

} // namespace osgPagedTexture
