// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixTexels.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgMultiRender
{

namespace
{

constexpr int texelsPerNode = 4; ///< Three of bounds, one of children.

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

/// The exponent byte, as that of a float, of the least power of two of which 255 make `extent`.
std::uint32_t exponentFor(double extent)
{
    int exponent = 0;
    std::frexp(extent / 255.0, &exponent); // not more than 2^exponent
    return static_cast<std::uint32_t>(std::clamp(exponent + 127, 1, 254));
}

} // namespace

void MixTexels::addFloats(const glm::vec4& values)
{
    texels.push_back(glm::floatBitsToUint(values));
}

void MixTexels::addRanges(const MixWeights& weights)
{
    const MixRules& given = weights.getRules();
    rules = glm::ivec4(static_cast<int>(weights.getRanges().size()), given.base,
                       given.excess == MixRules::Excess::Normalise, 0);
    background = glm::vec4(given.background);
    for (const MixRange& range : weights.getRanges())
        addFloats(
            {toShader(range.dr0), toShader(range.dr1), toShader(range.dr2), toShader(range.dr3)});
}

// The point of the segment's line that is nearest to the eye, and how far the ends are from it
// along the line: what is near the eye is exact so, however far the ends are.
void MixTexels::addLine(const glm::dvec3& first, const glm::dvec3& second)
{
    const double length = glm::length(second - first);
    const glm::dvec3 unit = length > 0.0 ? (second - first) / length : glm::dvec3(0.0);
    const double nearest = std::clamp(-glm::dot(first, unit), 0.0, length);
    // From the nearer end: the sum loses less.
    const glm::dvec3 place =
        nearest < 0.5 * length ? first + nearest * unit : second - (length - nearest) * unit;
    addFloats(glm::vec4(place, -nearest));
    addFloats(glm::vec4(unit, length - nearest));
}

void MixTexels::addSegments(const std::vector<KeySegment>& segments, const glm::dvec3& eye)
{
    for (const KeySegment& segment : segments)
        if (keys.w > 1)
            addLine(segment.first - eye, segment.second - eye);
        else
            addFloats(glm::vec4(segment.first - eye, 0.0));
}

// Boxes in bytes, from an origin and a power of two an axis. Those are floats as the segments' own
// places are, so that no box shrinks by rounding.
void MixTexels::addNode(const KeyTree::Node& node, const glm::dvec3& eye)
{
    glm::uvec4 origin(0u);
    glm::uvec3 lows(0u), highs(0u);
    for (int axis = 0; axis < 3; ++axis)
    {
        float low = std::numeric_limits<float>::max(), high = -low;
        for (std::uint32_t i = 0; i < node.used; ++i)
        {
            low = std::min(low, down(node.children[i].low[axis] - eye[axis]));
            high = std::max(high, up(node.children[i].high[axis] - eye[axis]));
        }
        const std::uint32_t exponent = exponentFor(double(high) - low);
        const double step = std::ldexp(1.0, static_cast<int>(exponent) - 127);
        origin[axis] = glm::floatBitsToUint(low);
        origin.w |= exponent << (8 * axis);
        for (std::uint32_t i = 0; i < node.used; ++i)
        {
            const double from = down(node.children[i].low[axis] - eye[axis]) - double(low);
            const double to = up(node.children[i].high[axis] - eye[axis]) - double(low);
            lows[axis] |= static_cast<std::uint32_t>(std::floor(from / step)) << (8 * i);
            highs[axis] |= static_cast<std::uint32_t>(std::min(255.0, std::ceil(to / step)))
                           << (8 * i);
        }
    }
    texels.push_back(origin);
    texels.emplace_back(lows, highs.x);
    texels.emplace_back(highs.y, highs.z, 0u, 0u);
}

void MixTexels::addNodes(const KeyTree& tree, const glm::dvec3& eye)
{
    // Few are faster looked at one by one; neighbouring fragments then read the same texels.
    if (tree.getSegments().size() <= LinearSize)
        return;
    keys.x = static_cast<int>(texels.size());
    for (const KeyTree::Node& node : tree.getNodes())
    {
        addNode(node, eye);
        glm::ivec4 addresses(0);
        for (int i = 0; i < static_cast<int>(node.used); ++i)
        {
            const KeyTree::Node::Child& child = node.children[static_cast<std::size_t>(i)];
            // A leaf is negative: its first segment and their number less 1, in one.
            addresses[i] =
                child.count == 0
                    ? keys.x + texelsPerNode * static_cast<int>(child.first)
                    : -1 - static_cast<int>(child.first * KeyTree::LeafSize + child.count - 1);
        }
        texels.emplace_back(addresses);
    }
}

void MixTexels::addCells(const KeyPoints& points, const glm::dvec3& eye)
{
    _moves.update(points);
    cells = _moves.getCells();
    grids = listed = glm::ivec4(0);
    if (!cells || points.getTree().getSegments().size() <= LinearSize)
        return;
    listed.x = keys.y;
    if (!_moves.isOwn())
    {
        listed.x = static_cast<int>(texels.size());
        addSegments(_moves.getListed(), eye);
        listed.y = static_cast<int>(texels.size());
        addSegments(_moves.getLoose(), eye);
        listed.z = static_cast<int>(_moves.getLoose().size());
    }
    grids.x = static_cast<int>(texels.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
    {
        const KeyCells::Root& root = cells->getRoots()[i];
        roots[i] = glm::vec4(root.low - eye, 1.0 / root.size);
        grids[1 + static_cast<int>(i)] = root.first;
    }
}

void MixTexels::set(const KeyPoints& points, const MixWeights& weights, const glm::dmat4& keysToEye)
{
    // Texel 0 is no place for anything: address 0 says none.
    texels.assign(1, glm::uvec4(0u));
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
        grids = glm::ivec4(0);
        return;
    }
    const std::vector<KeySegment>& segments = points.getTree().getSegments();
    const bool isJoined = points.getMode() != KeyMode::Points && points.getNumPoints() > 1;
    keys = glm::ivec4(0, static_cast<int>(texels.size()), static_cast<int>(segments.size()),
                      isJoined ? 2 : 1);
    addSegments(segments, eye);
    addNodes(points.getTree(), eye);
    addCells(points, eye);
}

} // namespace osgMultiRender
