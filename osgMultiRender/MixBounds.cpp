// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixBounds.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace osgMultiRender
{

namespace
{

using AllBounds = std::vector<MixWeights::Bounds>;

AllBounds unknown(const MixWeights& weights)
{
    return AllBounds(weights.getRanges().size() + 1, {0.0, 1.0});
}

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A part of the box that still has something to say.
struct Part
{
    MixBox box;
    double radius = 0.0;
    AllBounds bounds;

    bool operator<(const Part& other) const { return radius < other.radius; }
};

/// Whether a smaller part could still tell more than `known`, which holds values that do occur.
bool isOpen(const MixWeights::Bounds& bounds, const MixWeights::Bounds& known)
{
    const bool mayBeZero = known.high <= 0.0, mayBeOne = known.low >= 1.0;
    return (mayBeZero && bounds.high > 0.0) || (mayBeOne && bounds.low < 1.0);
}

bool isOpen(const AllBounds& bounds, const AllBounds& known)
{
    for (std::size_t i = 0; i < bounds.size(); ++i)
        if (isOpen(bounds[i], known[i]))
            return true;
    return false;
}

void widen(AllBounds& bounds, const AllBounds& by)
{
    for (std::size_t i = 0; i < bounds.size(); ++i)
    {
        bounds[i].low = std::min(bounds[i].low, by[i].low);
        bounds[i].high = std::max(bounds[i].high, by[i].high);
    }
}

std::array<MixBox, 2> halves(const MixBox& box)
{
    const auto longest = std::max_element(box.halfAxes.begin(), box.halfAxes.end(),
                                          [](const glm::dvec3& a, const glm::dvec3& b)
                                          { return glm::dot(a, a) < glm::dot(b, b); });
    const auto axis = static_cast<std::size_t>(longest - box.halfAxes.begin());
    std::array<MixBox, 2> result{box, box};
    result[0].halfAxes[axis] *= 0.5;
    result[1].halfAxes[axis] *= 0.5;
    result[0].center -= result[0].halfAxes[axis];
    result[1].center += result[1].halfAxes[axis];
    return result;
}

} // namespace

MixBox MixBox::from(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& matrix)
{
    MixBox box;
    box.center = glm::dvec3(matrix * glm::dvec4(0.5 * (low + high), 1.0));
    const glm::dvec3 half = 0.5 * (high - low);
    for (int axis = 0; axis < 3; ++axis)
        box.halfAxes[static_cast<std::size_t>(axis)] = half[axis] * glm::dvec3(matrix[axis]);
    return box;
}

double MixBox::radius() const
{
    const auto& [x, y, z] = halfAxes;
    return std::max({glm::length(x + y + z), glm::length(x + y - z), glm::length(x - y + z),
                     glm::length(x - y - z)});
}

AllBounds weightsOver(const KeyPoints& points, const MixWeights& weights, const glm::dvec3& center,
                      double radius, double margin)
{
    const double reach = radius + margin;
    if (!isFinite(center) || !std::isfinite(reach) || !(radius >= 0.0))
        return unknown(weights);
    // The distance changes by no more than the way.
    const double distance = points.distance(center);
    return weights.over(std::max(0.0, distance - reach), distance + reach);
}

AllBounds weightsOver(const KeyPoints& points, const MixWeights& weights, const MixBox& box,
                      double margin, int maxDistances)
{
    if (!isFinite(box.center) || !std::isfinite(box.radius()) || !std::isfinite(margin))
        return unknown(weights);
    AllBounds proven(weights.getRanges().size() + 1, {std::numeric_limits<double>::infinity(),
                                                      -std::numeric_limits<double>::infinity()});
    AllBounds known = proven;
    std::priority_queue<Part> open;
    const auto look = [&](const MixBox& part)
    {
        const double radius = part.radius(), distance = points.distance(part.center);
        widen(known, weights.over(distance, distance));
        open.push(
            {part, radius,
             weights.over(std::max(0.0, distance - radius - margin), distance + radius + margin)});
    };
    look(box);
    for (int distances = 1; distances + 2 <= maxDistances && !open.empty();)
    {
        const Part part = open.top();
        open.pop();
        if (!isOpen(part.bounds, known))
        {
            widen(proven, part.bounds);
            continue;
        }
        for (const MixBox& half : halves(part.box))
            look(half);
        distances += 2;
    }
    for (; !open.empty(); open.pop())
        widen(proven, open.top().bounds);
    return proven;
}

} // namespace osgMultiRender
