// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowMapFit.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgShadowVolume
{

namespace
{

constexpr unsigned int smallestMap = 16;

struct Interval
{
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void intersect(const Interval& other)
    {
        low = std::max(low, other.low);
        high = std::min(high, other.high);
    }
};

bool isKnown(const Hexahedron& h)
{
    return std::all_of(h.begin(), h.end(),
                       [](const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); });
}

/// Axes of a frame with this third axis, steady while it turns a little. All in the world.
glm::dmat3 frameOf(const glm::dvec3& axis)
{
    const glm::dvec3 size = glm::abs(axis);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                             : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                  : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, axis));
    return {x, glm::cross(axis, x), axis};
}

/// The rotation of a matrix that may scale too.
glm::dmat3 rotationOf(const glm::dmat4& matrix)
{
    const glm::dvec3 x = glm::normalize(glm::dvec3(matrix[0]));
    const glm::dvec3 y =
        glm::normalize(glm::dvec3(matrix[1]) - x * glm::dot(x, glm::dvec3(matrix[1])));
    return {x, y, glm::cross(x, y)};
}

/// The form dot(axis, toWorld * point) of a point in eye coordinates.
glm::dvec4 formAlong(const glm::dvec3& axis, const glm::dmat4& toWorld)
{
    return glm::dvec4(axis, 0.0) * toWorld;
}

double valueOf(const glm::dvec4& form, const glm::dvec3& point)
{
    return glm::dot(form, glm::dvec4(point, 1.0));
}

Interval over(const Hexahedron& h, const glm::dvec4& form)
{
    Interval result;
    for (const glm::dvec3& corner : h)
        result.add(valueOf(form, corner));
    return result;
}

/// Around all boxes; endless where one is unknown.
Interval around(const std::vector<Hexahedron>& boxes, const glm::dvec4& form)
{
    Interval result;
    for (const Hexahedron& box : boxes)
    {
        const Interval one = over(box, form);
        const bool known = isKnown(box);
        result.add(known ? one.low : -std::numeric_limits<double>::infinity());
        result.add(known ? one.high : std::numeric_limits<double>::infinity());
    }
    return result;
}

/// Takes the part of a form that the map must hold to [0, 1], border included. The size of texels
/// goes in steps and their edges lie on multiples of it, so that moving the camera neither moves
/// nor stretches them. Returns the size of a texel; 0 where there is nothing to hold.
double fitSide(glm::dvec4& form, Interval needed, unsigned int size, unsigned int border)
{
    if (!(needed.low <= needed.high) || !std::isfinite(needed.high - needed.low))
        return 0.0;
    // One texel is lost to the rounding down of the first edge.
    const double inner = double(size) - 2.0 * border - 1.0;
    const double least =
        std::max({needed.high - needed.low, 1e-9 * std::abs(needed.low), 1e-30}) / inner;
    constexpr double stepsToTwice = 8.0;
    const double texel = std::exp2(std::ceil(std::log2(least) * stepsToTwice) / stepsToTwice);
    const double first = (std::floor(needed.low / texel) - border) * texel;
    form.w -= first;
    form /= texel * size;
    return texel;
}

std::optional<ShadowMap> fitParallel(const EyeLight& light, const MapView& view, unsigned int size,
                                     unsigned int border)
{
    ShadowMap map;
    const glm::dmat3 frame = frameOf(-(rotationOf(view.toWorld) * light.position));
    double texel = 0.0;
    for (int i = 0; i < 2; ++i)
    {
        map.rows[i] = formAlong(frame[i], view.toWorld);
        Interval needed = around(view.casters, map.rows[i]);
        for (const Hexahedron& receivers : view.receivers)
            if (isKnown(receivers))
                needed.intersect(over(receivers, map.rows[i]));
        const double side = fitSide(map.rows[i], needed, size, border);
        if (side == 0.0)
            return std::nullopt;
        texel = std::max(texel, side);
    }
    // Casters take the depths from 0.01 to 0.99: polygon offset keeps them below 1, which is none.
    map.rows[2] = formAlong(frame[2], view.toWorld);
    Interval depths = around(view.casters, map.rows[2]);
    if (!std::isfinite(depths.high - depths.low))
        return std::nullopt;
    const double length = std::max(depths.high - depths.low, texel);
    map.rows[2].w -= depths.low;
    map.rows[2] *= 0.98 / length;
    map.rows[2].w += 0.01;
    map.bias = 0.5 * texel * 0.98 / length;
    return map;
}

/// The distances to the light between which the casters lie.
Interval distances(const glm::dvec3& light, const std::vector<Hexahedron>& casters)
{
    Interval result;
    for (const Hexahedron& caster : casters)
    {
        if (!isKnown(caster))
        {
            result.add(0.0);
            continue;
        }
        glm::dvec3 center(0.0);
        for (const glm::dvec3& corner : caster)
            center += 0.125 * corner;
        double radius = 0.0;
        for (const glm::dvec3& corner : caster)
        {
            radius = std::max(radius, glm::length(corner - center));
            result.add(glm::length(corner - light));
        }
        result.add(std::max(0.0, glm::length(center - light) - radius));
    }
    return result;
}

} // namespace

MapBudget fitBudget(const std::vector<unsigned int>& layersOfLights, unsigned int wanted,
                    unsigned int largest, unsigned int maxLayers, std::size_t bytes)
{
    MapBudget budget;
    budget.size = std::clamp(wanted, smallestMap, std::max(smallestMap, largest));
    const std::size_t affordable = bytes / (std::size_t(4) * smallestMap * smallestMap);
    for (unsigned int layers : layersOfLights)
    {
        if (budget.layers + layers > std::min<std::size_t>(maxLayers, affordable))
            break;
        budget.layers += layers;
        ++budget.lights;
    }
    while (budget.size > smallestMap && budget.getBytes() > bytes)
        budget.size = std::max(smallestMap, budget.size / 2);
    budget.isSmaller = budget.layers && budget.size < wanted;
    if (!budget.layers)
        budget.size = 0;
    return budget;
}

unsigned int mapBorder(unsigned int samples)
{
    // One more for the rounding of a float coordinate.
    return samples / 2 + 1;
}

ShadowMap::Kind mapKindOf(const EyeLight& light)
{
    if (light.isDirectional())
        return ShadowMap::Parallel;
    constexpr float widestCone = 80.0f; // whose border is 5.7 times the distance
    return light.type == EyeLight::Spot && light.spotCutoffDegrees < widestCone ? ShadowMap::Cone
                                                                                : ShadowMap::Cube;
}

std::optional<ShadowMap> fitMap(const EyeLight& light, const MapView& view, unsigned int size,
                                unsigned int samples)
{
    const unsigned int border = mapBorder(samples);
    if (view.casters.empty() || size < 2 * border + 2)
        return std::nullopt;
    const ShadowMap::Kind kind = mapKindOf(light);
    if (kind == ShadowMap::Parallel)
        return fitParallel(light, view, size, border);
    ShadowMap map;
    map.kind = kind;
    const Interval distance = distances(light.position, view.casters);
    // m is at least a distance by the square root of 3. What is nearer than a thousandth of the
    // farthest caster keeps its shadow by depth clamp, at the precision of the others.
    map.nearest = std::max(distance.low / std::sqrt(3.0), 1e-3 * distance.high);
    if (!(map.nearest > 0.0) || !std::isfinite(map.nearest))
        return std::nullopt;
    const glm::dmat3 rotation = rotationOf(view.toWorld);
    const glm::dmat3 axes =
        kind == ShadowMap::Cone ? frameOf(rotation * light.spotDirection) : glm::dmat3(1.0);
    for (int i = 0; i < 3; ++i)
    {
        const glm::dvec3 axis = axes[i] * rotation; // to eye coordinates
        map.rows[i] = glm::dvec4(axis, -glm::dot(axis, light.position));
    }
    const double tangent =
        kind == ShadowMap::Cone ? std::tan(glm::radians(double(light.spotCutoffDegrees))) : 1.0;
    map.spread = std::max(tangent, 1e-6) * size / (double(size) - 2.0 * border);
    map.bias = map.spread / size;
    return map;
}

ShadowMap::Place ShadowMap::find(const glm::dvec3& eye) const
{
    glm::dvec3 d(valueOf(rows[0], eye), valueOf(rows[1], eye), valueOf(rows[2], eye));
    Place place;
    if (kind == Parallel)
    {
        place.uv = glm::dvec2(d);
        place.depth = d.z - bias;
    }
    else
    {
        if (kind == Cube)
        {
            const glm::dvec3 size = glm::abs(d);
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            place.face = 2 * axis + (d[axis] < 0.0 ? 1 : 0);
            d = {d[(axis + 1) % 3], d[(axis + 2) % 3], size[axis]};
        }
        if (!(d.z > 0.0))
            return place;
        place.uv = 0.5 + 0.5 * glm::dvec2(d) / (d.z * spread);
        place.depth = 1.0 - nearest / (d.z * (1.0 - bias));
    }
    place.isInside =
        place.uv.x >= 0.0 && place.uv.x <= 1.0 && place.uv.y >= 0.0 && place.uv.y <= 1.0;
    return place;
}

glm::dmat4 ShadowMap::getMatrix(unsigned int face) const
{
    const glm::dvec4 one(0.0, 0.0, 0.0, 1.0);
    if (kind == Parallel)
        return glm::transpose(
            glm::dmat4(2.0 * rows[0] - one, 2.0 * rows[1] - one, 2.0 * rows[2] - one, one));
    const int axis = kind == Cube ? int(face / 2) : 2;
    const glm::dvec4 m = (kind == Cube && face % 2 ? -1.0 : 1.0) * rows[axis];
    return glm::transpose(glm::dmat4(rows[(axis + 1) % 3] / spread, rows[(axis + 2) % 3] / spread,
                                     m - 2.0 * nearest * one, m));
}

bool ShadowMap::mayShow(const Hexahedron& caster, unsigned int face) const
{
    const glm::dmat4 matrix = getMatrix(face);
    // Outside of one of the four sides with all corners; depths are clamped, not cut.
    bool isOut[4] = {true, true, true, true};
    for (const glm::dvec3& corner : caster)
    {
        const glm::dvec4 clip = matrix * glm::dvec4(corner, 1.0);
        isOut[0] = isOut[0] && clip.x > clip.w;
        isOut[1] = isOut[1] && clip.x < -clip.w;
        isOut[2] = isOut[2] && clip.y > clip.w;
        isOut[3] = isOut[3] && clip.y < -clip.w;
    }
    return !(isOut[0] || isOut[1] || isOut[2] || isOut[3]);
}

} // namespace osgShadowVolume
