// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixTexels.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgMultiRender
{

namespace
{

constexpr int texelsPerNode = 7; ///< Six of bounds, one of children.

/// Infinity is no number that every GLSL compiler keeps. Above what mix.glsl calls no distance.
float toShader(double distance)
{
    return static_cast<float>(std::clamp(distance, -4e30, 4e30));
}

/// Rounded so that boxes never shrink.
float down(double value)
{
    const auto rounded = static_cast<float>(value);
    return rounded > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                           : rounded;
}

float up(double value)
{
    return -down(-value);
}

/// The point of the segment's line that is nearest to the eye, and how far the ends are from it
/// along the line: what is near the eye is exact so, however far the ends are.
void appendLine(std::vector<glm::vec4>& texels, const glm::dvec3& first, const glm::dvec3& second)
{
    const glm::dvec3 along = second - first;
    const double length = glm::length(along);
    if (!(length > 0.0))
    {
        texels.emplace_back(first, 0.0f);
        texels.emplace_back(0.0f);
        return;
    }
    const glm::dvec3 unit = along / length;
    const double nearest = std::clamp(-glm::dot(first, unit), 0.0, length);
    // From the nearer end: the sum loses less.
    const glm::dvec3 place =
        nearest < 0.5 * length ? first + nearest * unit : second - (length - nearest) * unit;
    texels.emplace_back(place, static_cast<float>(-nearest));
    texels.emplace_back(unit, static_cast<float>(length - nearest));
}

} // namespace

void MixTexels::addRanges(const MixWeights& weights)
{
    const MixRules& given = weights.getRules();
    rules = glm::ivec4(static_cast<int>(weights.getRanges().size()), given.base,
                       given.excess == MixRules::Excess::Normalise, 0);
    background = glm::vec4(given.background);
    for (const MixRange& range : weights.getRanges())
        texels.emplace_back(toShader(range.dr0), toShader(range.dr1), toShader(range.dr2),
                            toShader(range.dr3));
}

void MixTexels::addSegments(const KeyPoints& points, const glm::dvec3& eye)
{
    const std::vector<KeySegment>& segments = points.getTree().getSegments();
    const bool isJoined = points.getMode() != KeyMode::Points && points.getNumPoints() > 1;
    keys = glm::ivec4(0, static_cast<int>(texels.size()), static_cast<int>(segments.size()),
                      isJoined ? 2 : 1);
    for (const KeySegment& segment : segments)
        if (isJoined)
            appendLine(texels, segment.first - eye, segment.second - eye);
        else
            texels.emplace_back(segment.first - eye, 0.0f);
}

void MixTexels::addNodes(const KeyTree& tree, const glm::dvec3& eye)
{
    // Few are faster looked at one by one; neighbouring fragments then read the same texels.
    if (tree.getSegments().size() <= LinearSize)
        return;
    const int first = static_cast<int>(texels.size());
    keys.x = first;
    const auto address = [&](const KeyTree::Node::Child& child) -> float
    {
        if (child.count == 0)
            return static_cast<float>(first + texelsPerNode * static_cast<int>(child.first));
        // A leaf is negative: its first segment and their number less 1, in one.
        return -1.0f - static_cast<float>(child.first * KeyTree::LeafSize + child.count - 1);
    };
    for (const KeyTree::Node& node : tree.getNodes())
    {
        glm::mat3x4 low(0.0f), high(0.0f);
        glm::vec4 addresses(0.0f);
        for (int i = 0; i < static_cast<int>(node.used); ++i)
        {
            const KeyTree::Node::Child& child = node.children[static_cast<std::size_t>(i)];
            for (int axis = 0; axis < 3; ++axis)
            {
                low[axis][i] = down(child.low[axis] - eye[axis]);
                high[axis][i] = up(child.high[axis] - eye[axis]);
            }
            addresses[i] = address(child);
        }
        texels.insert(texels.end(), {addresses, low[0], high[0], low[1], high[1], low[2], high[2]});
    }
}

void MixTexels::set(const KeyPoints& points, const MixWeights& weights, const glm::dmat4& keysToEye)
{
    // Texel 0 is no place for anything: address 0 says none.
    texels.assign(1, glm::vec4(0.0f));
    addRanges(weights);
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(keysToEye));
    const glm::dvec3 eye = -(inverse * glm::dvec3(keysToEye[3]));
    frame = glm::mat3(inverse);
    float sum = 0.0f;
    for (int column = 0; column < 3; ++column)
        sum += glm::dot(glm::abs(frame[column]), glm::vec3(1.0f)) +
               std::abs(static_cast<float>(eye[column]));
    if (!std::isfinite(sum))
    {
        frame = glm::mat3(1.0f);
        keys = glm::ivec4(0, 0, 0, 1);
        return;
    }
    addSegments(points, eye);
    addNodes(points.getTree(), eye);
}

} // namespace osgMultiRender
