// SPDX-License-Identifier: MIT
#include <osgMultiRender/KeyTree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace osgMultiRender
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

double boxDistance(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& point)
{
    const glm::dvec3 away = glm::max(glm::max(low - point, point - high), glm::dvec3(0.0));
    return glm::length(away);
}

} // namespace

double KeySegment::distance(const glm::dvec3& point) const
{
    const glm::dvec3 along = second - first;
    const double square = glm::dot(along, along);
    if (!(square > 0.0))
        return glm::length(point - first);
    const double share = std::clamp(glm::dot(point - first, along) / square, 0.0, 1.0);
    // From the nearer end, so that what touches an end is exactly at it.
    return share < 0.5 ? glm::length(point - (first + share * along))
                       : glm::length(point - (second - (1.0 - share) * along));
}

KeyTree::KeyTree(std::vector<KeySegment> segments) : _segments(std::move(segments))
{
    // A box must never be farther than what it holds. The distance to a line may round down; that
    // to a point rounds as that to a box, and without slack equal points are not looked at twice.
    if (std::any_of(_segments.begin(), _segments.end(),
                    [](const KeySegment& segment) { return segment.first != segment.second; }))
        _slack = 1.0 - 1e-14;
    if (_segments.size() > LeafSize)
    {
        _nodes.reserve(_segments.size() / 4);
        build(0, static_cast<std::uint32_t>(_segments.size()));
    }
}

std::uint32_t KeyTree::split(std::uint32_t begin, std::uint32_t end)
{
    glm::dvec3 low(infinity), high(-infinity);
    for (std::uint32_t i = begin; i < end; ++i)
    {
        const glm::dvec3 twiceMiddle = _segments[i].first + _segments[i].second;
        low = glm::min(low, twiceMiddle);
        high = glm::max(high, twiceMiddle);
    }
    const glm::dvec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    // Whole leaves on the left, so that few are half empty.
    const std::uint32_t half = (end - begin + 1) / 2;
    const std::uint32_t left =
        end - begin > LeafSize ? (half + LeafSize - 1) / LeafSize * LeafSize : half;
    const auto at = _segments.begin();
    std::nth_element(at + begin, at + begin + left, at + end,
                     [axis](const KeySegment& a, const KeySegment& b)
                     { return a.first[axis] + a.second[axis] < b.first[axis] + b.second[axis]; });
    return begin + left;
}

KeyTree::Node::Child KeyTree::makeChild(std::uint32_t begin, std::uint32_t end)
{
    Node::Child child;
    child.low = glm::dvec3(infinity);
    child.high = glm::dvec3(-infinity);
    for (std::uint32_t i = begin; i < end; ++i)
    {
        child.low = glm::min(child.low, glm::min(_segments[i].first, _segments[i].second));
        child.high = glm::max(child.high, glm::max(_segments[i].first, _segments[i].second));
    }
    if (end - begin <= LeafSize)
    {
        child.first = begin;
        child.count = end - begin;
    }
    else
        child.first = build(begin, end);
    return child;
}

std::uint32_t KeyTree::build(std::uint32_t begin, std::uint32_t end)
{
    const auto index = static_cast<std::uint32_t>(_nodes.size());
    _nodes.emplace_back();
    const std::uint32_t middle = split(begin, end);
    std::array<std::pair<std::uint32_t, std::uint32_t>, 4> parts;
    std::uint32_t used = 0;
    for (const auto& [from, to] : {std::pair(begin, middle), std::pair(middle, end)})
    {
        if (to - from <= LeafSize)
            parts[used++] = {from, to};
        else
        {
            const std::uint32_t quarter = split(from, to);
            parts[used++] = {from, quarter};
            parts[used++] = {quarter, to};
        }
    }
    for (std::uint32_t i = 0; i < used; ++i)
    {
        // Not in one expression: building a child moves the nodes.
        const Node::Child child = makeChild(parts[i].first, parts[i].second);
        _nodes[index].children[i] = child;
    }
    _nodes[index].used = used;
    return index;
}

double KeyTree::distance(const glm::dvec3& point) const
{
    double nearest = infinity;
    const auto look = [&](std::uint32_t first, std::uint32_t count)
    {
        for (std::uint32_t i = first; i < first + count; ++i)
        {
            const double distance = _segments[i].distance(point);
            if (distance < nearest) // never for what is not a number
                nearest = distance;
        }
    };
    if (_nodes.empty())
    {
        look(0, static_cast<std::uint32_t>(_segments.size()));
        return nearest;
    }

    struct Entry
    {
        double bound;
        const Node::Child* child;
    };
    std::array<Entry, MaxStack> stack;
    std::size_t depth = 0;
    const Node* node = &_nodes.front();
    for (;;)
    {
        const std::size_t base = depth;
        for (std::uint32_t i = 0; i < node->used; ++i)
        {
            const Node::Child& child = node->children[i];
            const double bound = _slack * boxDistance(child.low, child.high, point);
            if (!(bound < nearest))
                continue;
            std::size_t place = depth++; // the nearest one on top
            for (; place > base && stack[place - 1].bound < bound; --place)
                stack[place] = stack[place - 1];
            stack[place] = {bound, &child};
        }
        node = nullptr;
        while (depth > 0 && !node)
        {
            const Entry entry = stack[--depth];
            if (!(entry.bound < nearest))
                continue;
            if (entry.child->count > 0)
                look(entry.child->first, entry.child->count);
            else
                node = &_nodes[entry.child->first];
        }
        if (!node)
            return nearest;
    }
}

} // namespace osgMultiRender
