// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightScreen.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgShadowVolume
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec4 rowOf(const glm::dmat4& m, int row)
{
    return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

/// The smallest w of a point on the near plane, where that is a plane of equal w; else 0.
double nearestW(const glm::dmat4& projection)
{
    const glm::dvec4 w = rowOf(projection, 3), near = rowOf(projection, 2) + w;
    const glm::dvec3 normal(near), axis(w);
    const double wLength = glm::dot(axis, axis);
    if (wLength == 0.0)
        return w.w;
    const double slope = glm::dot(normal, axis) / wLength;
    // The part of the plane's normal that is not along w: rounding in a common projection.
    if (!(slope > 0.0) || glm::length(normal - slope * axis) > 1e-12 * glm::length(normal))
        return 0.0;
    return w.w - near.w / slope;
}

struct Range
{
    double low = infinity, high = -infinity;

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// The values of x / w over the part of a sphere with w of at least `least`, for two linear forms
/// of the point.
///
/// The forms take the sphere to an ellipse in the plane (w, x). A ratio is extreme where a ray from
/// the origin touches the ellipse, or where the line w = least cuts it.
Range ratioOver(const EyeSphere& sphere, const glm::dvec4& x, const glm::dvec4& w, double least)
{
    const double r2 = sphere.radius * sphere.radius;
    const double xx = r2 * glm::dot(glm::dvec3(x), glm::dvec3(x));
    const double xw = r2 * glm::dot(glm::dvec3(x), glm::dvec3(w));
    const double ww = r2 * glm::dot(glm::dvec3(w), glm::dvec3(w));
    const double cx = glm::dot(x, glm::dvec4(sphere.center, 1.0));
    const double cw = glm::dot(w, glm::dvec4(sphere.center, 1.0));
    const double lowest = cw - std::sqrt(ww);
    const double a = cw * cw - ww, b = cx * cw - xw, c = cx * cx - xx;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    Range range;
    if (lowest >= least)
    {
        range.add((b - root) / a);
        range.add((b + root) / a);
        return range;
    }
    // Both ends of the cut and the point of largest w belong to the part that counts.
    const double along = (least - cw) / ww;
    const double across =
        std::sqrt(std::max(0.0, (xx - xw * xw / ww) * (1.0 - along * along * ww)));
    range.add((cx + xw * along - across) / least);
    range.add((cx + xw * along + across) / least);
    range.add((cx + xw / std::sqrt(ww)) / (cw + std::sqrt(ww)));
    for (double k : {(b - root) / a, (b + root) / a})
    {
        // Where x - k w, which is 0 there, is farthest from what it is at the centre.
        const double side = cx - k * cw > 0.0 ? -1.0 : 1.0;
        const double width = std::sqrt(std::max(0.0, xx - 2.0 * k * xw + k * k * ww));
        if (cw + side * (xw - k * ww) / width >= least)
            range.add(k);
    }
    return range;
}

struct Span
{
    int low, size;
};

/// The pixels from `low` to `high` in window coordinates, with one more on each side.
std::optional<Span> pixels(const Range& ndc, double first, double size)
{
    const double low = std::max(first, std::floor(first + 0.5 * size * (ndc.low + 1.0)) - 1.0);
    const double high =
        std::min(first + size, std::ceil(first + 0.5 * size * (ndc.high + 1.0)) + 1.0);
    if (!(low < high))
        return std::nullopt;
    return Span{int(std::floor(low)), int(std::ceil(high) - std::floor(low))};
}

} // namespace

EyeSphere sphereOf(const EyeLight& light, double reach)
{
    if (light.isDirectional() || !std::isfinite(reach))
        return {glm::dvec3(0.0), infinity};
    if (light.type != EyeLight::Spot || !(light.spotCutoffDegrees < 90.0f))
        return {light.position, reach};
    const double angle = glm::radians(double(light.spotCutoffDegrees));
    // A narrow cone touches its sphere with the apex and the rim of the cap, a wide one with the
    // rim alone, which then is a great circle.
    if (light.spotCutoffDegrees <= 45.0f)
    {
        const double radius = reach / (2.0 * std::cos(angle));
        return {light.position + light.spotDirection * radius, radius};
    }
    return {light.position + light.spotDirection * (reach * std::cos(angle)),
            reach * std::sin(angle)};
}

std::optional<ScreenBounds> screenBounds(const EyeSphere& sphere, const glm::dmat4& projection,
                                         const glm::dvec4& viewport)
{
    const int left = int(std::floor(viewport.x)), bottom = int(std::floor(viewport.y));
    const ScreenBounds all{left,
                           bottom,
                           int(std::ceil(viewport.x + viewport.z)) - left,
                           int(std::ceil(viewport.y + viewport.w)) - bottom,
                           0.0,
                           1.0};
    const glm::dvec4 w = rowOf(projection, 3);
    const double least = nearestW(projection);
    const double most =
        glm::dot(w, glm::dvec4(sphere.center, 1.0)) + sphere.radius * glm::length(glm::dvec3(w));
    if (most < least * (1.0 - 1e-6)) // the GPU clips in float
        return std::nullopt;
    Range range[3];
    for (int i = 0; i < 3; ++i)
    {
        range[i] = ratioOver(sphere, rowOf(projection, i), w, least);
        if (!(least > 0.0) || !std::isfinite(range[i].low) || !std::isfinite(range[i].high))
            return all;
    }
    constexpr double depthMargin = 4e-6;
    ScreenBounds bounds;
    bounds.nearDepth = std::max(0.0, 0.5 * (range[2].low + 1.0) - depthMargin);
    bounds.farDepth = std::min(1.0, 0.5 * (range[2].high + 1.0) + depthMargin);
    const auto x = pixels(range[0], viewport.x, viewport.z);
    const auto y = pixels(range[1], viewport.y, viewport.w);
    if (!x || !y || bounds.nearDepth > bounds.farDepth)
        return std::nullopt;
    bounds.x = x->low;
    bounds.width = x->size;
    bounds.y = y->low;
    bounds.height = y->size;
    return bounds;
}

bool hidesItsShadows(const EyeLight& light, const glm::dmat4& projection,
                     const glm::dvec4& viewport)
{
    const glm::dvec4 x = rowOf(projection, 0), y = rowOf(projection, 1), w = rowOf(projection, 3);
    const bool isPerspective = glm::dvec3(w) != glm::dvec3(0.0);
    if (isPerspective == light.isDirectional())
        return false;
    if (!isPerspective)
    {
        // A point that is lit from a depth of 2 in front of it, near to far, moves by this much.
        const glm::dvec4 depth = rowOf(projection, 2);
        const double along = -glm::dot(glm::dvec3(depth), light.position);
        const double dx = std::abs(glm::dot(glm::dvec3(x), light.position)) * 2.0 / along;
        const double dy = std::abs(glm::dot(glm::dvec3(y), light.position)) * 2.0 / along;
        return along > 0.0 && dx * 0.5 * viewport.z < 0.5 && dy * 0.5 * viewport.w < 0.5;
    }
    // x, y and w vanish at the eye, so for the light they are those of its way from there. A caster
    // seen at x / w = c with w of at least `least` throws its shadow, at most, to
    // c + (c light.w - light.x) / (least - |light.w|), in the limit of an endless way.
    const glm::dvec4 position(light.position, 1.0);
    const double lw = std::abs(glm::dot(w, position));
    const double room = nearestW(projection) - lw;
    // Twice |w|: c of a caster just off the screen is a little above 1.
    const double dx = std::abs(glm::dot(x, position)) + 2.0 * lw;
    const double dy = std::abs(glm::dot(y, position)) + 2.0 * lw;
    return room > 0.0 && dx * 0.5 * viewport.z < 0.5 * room && dy * 0.5 * viewport.w < 0.5 * room;
}

} // namespace osgShadowVolume
