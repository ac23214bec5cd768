// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TexelNeed.h>

#include <osgPagedTexture/BlockFormat.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgPagedTexture
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// The shortest that the matrix makes of a unit, for matrices without shear.
double leastScale(const glm::dmat3& linear)
{
    return std::min({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
}

/// Largest cosine between a normal of the surface and any direction from `eye` into its box.
double facing(const TexelSurface& surface, const glm::dvec3& eye)
{
    const glm::dvec3 middle = 0.5 * (surface.low + surface.high);
    const double distance = glm::distance(eye, middle);
    const double radius = 0.5 * glm::distance(surface.low, surface.high);
    if (glm::length(surface.axis) < 0.5 || distance <= radius)
        return 1.0;
    const double cosine = std::abs(glm::dot(surface.axis, (middle - eye) / distance));
    const double angle =
        std::acos(std::min(1.0, cosine)) - surface.spread - std::asin(radius / distance);
    return angle <= 0.0 ? 1.0 : std::cos(angle);
}

/// Pixels of a unit of the surface's area where rays are parallel.
double parallelPixels(const TexelSurface& surface, const glm::dmat3& linear)
{
    // An area with normal n is seen as det * |n * direction| / |M direction|, direction along the
    // view in coordinates of the surface.
    const glm::dvec3 along = glm::inverse(linear) * glm::dvec3(0.0, 0.0, 1.0);
    double cosine = 1.0;
    if (glm::length(surface.axis) >= 0.5)
    {
        const double middle = std::abs(glm::dot(surface.axis, along)) / glm::length(along);
        cosine = std::cos(std::max(0.0, std::acos(std::min(1.0, middle)) - surface.spread));
    }
    return std::abs(glm::determinant(linear)) * cosine * glm::length(along);
}

/// Along the view, of the box; negative behind the eye.
double nearestDepth(const TexelSurface& surface, const TexelView& view, const glm::dmat3& linear)
{
    const glm::dvec3 towards(linear[0].z, linear[1].z, linear[2].z);
    const double middle =
        glm::dot(towards, 0.5 * (surface.low + surface.high)) + view.toEye[3].z - view.moved.z;
    return -middle - glm::dot(glm::abs(towards), 0.5 * (surface.high - surface.low));
}

double perspectivePixels(const TexelSurface& surface, const TexelView& view,
                         const glm::dmat3& linear)
{
    const double least = leastScale(linear);
    const glm::dvec3 eye = glm::inverse(linear) * (view.moved - glm::dvec3(view.toEye[3]));
    const glm::dvec3 nearest = glm::clamp(eye, surface.low, surface.high);
    const glm::dvec3 farthest = glm::max(glm::abs(surface.low - eye), glm::abs(surface.high - eye));
    const double distance = least * glm::distance(eye, nearest);
    const double depth = std::max(distance / view.corner, nearestDepth(surface, view, linear));
    if (!(depth > 0.0))
        return Infinity;
    // An area with normal n at p is seen as det * |n * p| / depth^3, and |p| is at most corner *
    // depth / least, or as far as the box goes.
    const double slant = std::min(view.corner, least * glm::length(farthest) / depth);
    return std::abs(glm::determinant(linear)) / least * facing(surface, eye) * slant /
           (depth * depth);
}

} // namespace

double pixelsOfTexture(const TexelSurface& surface, const TexelView& view)
{
    const bool hasBox = glm::all(glm::lessThanEqual(surface.low, surface.high));
    if (!(surface.uvDensity > 0.0) || !std::isfinite(surface.uvDensity) || !hasBox)
        return Infinity;
    const glm::dmat3 linear(view.toEye);
    const double determinant = std::abs(glm::determinant(linear));
    if (!(determinant > 0.0) || !std::isfinite(determinant))
        return determinant == 0.0 ? 0.0 : Infinity; // Flat: it is seen from the edge at most.
    const double seen = view.isParallel ? parallelPixels(surface, linear)
                                        : perspectivePixels(surface, view, linear);
    const double pixels = seen * view.pixelsX * view.pixelsY / surface.uvDensity;
    return std::isnan(pixels) ? Infinity : std::abs(pixels);
}

double levelOnOnePixel(const TexelTexture& texture)
{
    // GL takes the longer side of what a pixel covers, or with anisotropy at least its share of
    // it: neither is below the root of the area.
    const double texels = double(texture.width) * texture.height;
    return 0.5 * std::log2(texels / std::max(1.0, texture.anisotropy)) + texture.bias;
}

double neededLevel(const TexelTexture& texture, double pixels)
{
    const int last = levelCount(std::max(1, texture.width), std::max(1, texture.height)) - 1;
    if (pixels == 0.0)
        return last;
    const double level = levelOnOnePixel(texture) - 0.5 * std::log2(pixels);
    return std::isnan(level) ? 0.0 : std::clamp(level, 0.0, double(last));
}

} // namespace osgPagedTexture
