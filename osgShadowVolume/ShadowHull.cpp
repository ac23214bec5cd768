// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowHull.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgShadowVolume
{

namespace
{

const glm::dvec3 nowhere(std::numeric_limits<double>::quiet_NaN());

Hexahedron unknown()
{
    Hexahedron result;
    result.fill(nowhere);
    return result;
}

double largestCoordinate(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const Hexahedron& h)
{
    return std::all_of(h.begin(), h.end(), [](const glm::dvec3& v) { return isFinite(v); });
}

glm::dvec3 middleOf(const Hexahedron& h)
{
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : h)
        sum += 0.125 * corner;
    return sum;
}

/// The end of the edge that starts at `corner` along a bit.
constexpr unsigned int endOf(unsigned int corner, unsigned int bit)
{
    return corner | (1u << bit);
}

/// The points where w has one sign and is not lost to cancellation; else false.
bool unproject(const glm::dmat4& inverse, double nearOrFar, Hexahedron& corners, unsigned int first)
{
    constexpr double cancelled = 1e-9;
    for (unsigned int i = 0; i < 4; ++i)
    {
        const glm::dvec4 clip((i & 1u) ? 1.0 : -1.0, (i & 2u) ? 1.0 : -1.0, nearOrFar, 1.0);
        const glm::dvec4 point = inverse * clip;
        double terms = 0.0;
        for (int column = 0; column < 4; ++column)
            terms = std::max(terms, std::abs(inverse[column][3] * clip[column]));
        if (!(point.w > cancelled * terms))
            return false;
        corners[first + i] = glm::dvec3(point) / point.w;
    }
    return true;
}

} // namespace

Hexahedron frustumOf(const glm::dmat4& projection)
{
    const glm::dmat4 inverse = glm::inverse(projection);
    Hexahedron result;
    if (!unproject(inverse, -1.0, result, 0) || !unproject(inverse, 1.0, result, 4))
        return unknown();
    return result;
}

Hexahedron nearRectangleOf(const glm::dmat4& projection)
{
    Hexahedron result;
    if (!unproject(glm::inverse(projection), -1.0, result, 0))
        return unknown();
    std::copy_n(result.begin(), 4, result.begin() + 4);
    return result;
}

Hexahedron boxOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& modelview)
{
    const bool isAffine = modelview[0][3] == 0.0 && modelview[1][3] == 0.0 &&
                          modelview[2][3] == 0.0 && modelview[3][3] == 1.0;
    if (!isAffine || !glm::all(glm::lessThanEqual(low, high)))
        return unknown();
    Hexahedron result;
    for (unsigned int i = 0; i < 8; ++i)
    {
        const glm::dvec3 corner((i & 1u) ? high.x : low.x, (i & 2u) ? high.y : low.y,
                                (i & 4u) ? high.z : low.z);
        result[i] = glm::dvec3(modelview * glm::dvec4(corner, 1.0));
    }
    return result;
}

ShadowHull::ShadowHull(const Hexahedron& hexahedron, const glm::dvec4& light)
    : _corners(hexahedron), _origin(middleOf(hexahedron)), _isAtInfinity(light.w == 0.0)
{
    // Of a direction only the direction counts, and its square must neither overflow nor vanish.
    const double size = largestCoordinate(glm::dvec3(light));
    _light = _isAtInfinity ? glm::normalize(glm::dvec3(light) / size)
                           : glm::dvec3(light) / light.w - _origin;
    if (!isFinite(hexahedron) || !isFinite(_origin) || !isFinite(_light))
        return;
    for (glm::dvec3& corner : _corners)
    {
        _extent = std::max(_extent, largestCoordinate(corner));
        corner -= _origin;
    }
    const glm::dvec3 towards = _isAtInfinity ? _light : glm::normalize(_light);
    _towards = axisAlong(isFinite(towards) ? towards : glm::dvec3(1.0, 0.0, 0.0));
    _axes.push_back(_towards);
    for (unsigned int bit = 0; bit < 3; ++bit)
    {
        const unsigned int next = (bit + 1) % 3, other = (bit + 2) % 3;
        for (unsigned int side = 0; side < 2; ++side)
        {
            // Diagonals give the normal even where an edge of the face has no length.
            const unsigned int corner = side << other;
            add(_corners[endOf(endOf(corner, bit), next)] - _corners[corner],
                _corners[endOf(corner, bit)] - _corners[endOf(corner, next)]);
        }
        for (unsigned int i = 0; i < 8; ++i)
            if (!(i & (1u << bit)))
            {
                addEdge(_corners[endOf(i, bit)] - _corners[i]);
                add(_corners[endOf(i, bit)] - _corners[i],
                    _isAtInfinity ? _light : _light - _corners[i]);
            }
    }
    for (const glm::dvec3& corner : _corners)
        addEdge(_isAtInfinity ? _light : _light - corner);
}

void ShadowHull::addEdge(const glm::dvec3& way)
{
    const glm::dvec3 unit = glm::normalize(way);
    const bool isNew = std::none_of(_edges.begin(), _edges.end(),
                                    [&](const glm::dvec3& edge)
                                    { return std::abs(glm::dot(edge, unit)) >= 1.0 - 1e-12; });
    if (isFinite(unit) && isNew)
        _edges.push_back(unit);
}

ShadowHull::Axis ShadowHull::axisAlong(const glm::dvec3& unit) const
{
    Axis axis{unit, glm::dot(unit, _corners[0]), glm::dot(unit, _corners[0]),
              glm::dot(unit, _light)};
    for (const glm::dvec3& corner : _corners)
    {
        const double at = glm::dot(unit, corner);
        axis.low = std::min(axis.low, at);
        axis.high = std::max(axis.high, at);
    }
    return axis;
}

void ShadowHull::add(const glm::dvec3& first, const glm::dvec3& second)
{
    const glm::dvec3 unit =
        glm::normalize(glm::cross(glm::normalize(first), glm::normalize(second)));
    if (!isFinite(unit))
        return;
    // A flat hexahedron has most of its axes twice.
    for (const Axis& axis : _axes)
        if (std::abs(glm::dot(axis.direction, unit)) >= 1.0)
            return;
    _axes.push_back(axisAlong(unit));
}

/// How far from the hexahedron to the light a point of the box can lie, as a share of the way, or
/// as a length where the light is at infinity. Without it what a direction lacks to be exactly one
/// of the hull would count over the whole way to a light far off.
double ShadowHull::shareTowardsLight(const Hexahedron& box) const
{
    double farthest = -std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : box)
        farthest = std::max(farthest, glm::dot(_towards.direction, corner));
    if (_isAtInfinity)
        return std::max(0.0, farthest - _towards.low);
    if (!(_towards.light > _towards.high) || !(farthest < _towards.light))
        return 1.0;
    return std::max(0.0, (farthest - _towards.low) / (_towards.light - _towards.low));
}

ShadowHull::Relation ShadowHull::along(const Axis& axis, const Hexahedron& box, double share,
                                       double margin) const
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const glm::dvec3& corner : box)
    {
        const double at = glm::dot(axis.direction, corner);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    const double up = _isAtInfinity ? axis.light : axis.light - axis.high;
    const double down = _isAtInfinity ? axis.light : axis.light - axis.low;
    const double highest = axis.high + share * std::max(0.0, up);
    const double lowest = axis.low + share * std::min(0.0, down);
    if (low > highest + margin || high < lowest - margin)
        return Relation::Apart;
    const double middle = 0.5 * (low + high);
    return middle >= lowest && middle <= highest ? Relation::Within : Relation::Across;
}

bool ShadowHull::isApartByEdges(const Hexahedron& box, double share, double margin) const
{
    for (unsigned int bit = 0; bit < 3; ++bit)
    {
        const glm::dvec3 edge = glm::normalize(box[1u << bit] - box[0]);
        for (const glm::dvec3& other : _edges)
        {
            const glm::dvec3 unit = glm::normalize(glm::cross(edge, other));
            if (isFinite(unit) && along(axisAlong(unit), box, share, margin) == Relation::Apart)
                return true;
        }
    }
    return false;
}

bool ShadowHull::mayTouch(const Hexahedron& box) const
{
    if (touchesEverything() || !isFinite(box))
        return true;
    Hexahedron relative = box;
    double extent = _extent;
    for (glm::dvec3& corner : relative)
    {
        extent = std::max(extent, largestCoordinate(corner));
        corner -= _origin;
    }
    const double share = shareTowardsLight(relative), margin = Margin * extent;
    // A point within all faces is in the hull; those of a flat hull are not all among the axes.
    bool isWithin = _axes.size() >= 4;
    for (const Axis& axis : _axes)
    {
        const Relation relation = along(axis, relative, share, margin);
        if (relation == Relation::Apart)
            return false;
        isWithin = isWithin && relation == Relation::Within;
    }
    if (isWithin)
        return true; // as most that touch
    // The faces of the box, which may be flat or a line.
    for (unsigned int bit = 0; bit < 3; ++bit)
    {
        const glm::dvec3 unit = glm::normalize(glm::cross(
            relative[1u << bit] - relative[0], relative[1u << ((bit + 1) % 3)] - relative[0]));
        if (isFinite(unit) && along(axisAlong(unit), relative, share, margin) == Relation::Apart)
            return false;
    }
    return !isApartByEdges(relative, share, margin);
}

} // namespace osgShadowVolume
