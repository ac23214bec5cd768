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

struct Box
{
    glm::dvec3 low{infinity}, high{-infinity};
    std::uint32_t count = 0; ///< Of segments.

    void add(const KeySegment& segment)
    {
        low = glm::min(low, glm::min(segment.first, segment.second));
        high = glm::max(high, glm::max(segment.first, segment.second));
        ++count;
    }

    void add(const Box& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
        count += other.count;
    }

    /// What a walk is expected to pay for it: its edges, as boxes of lines and points have no area,
    /// by its leaves.
    double cost() const
    {
        const glm::dvec3 extent = high - low;
        const std::uint32_t leaves = (count + KeyTree::LeafSize - 1) / KeyTree::LeafSize;
        return count > 0 ? (extent.x + extent.y + extent.z) * leaves : 0.0;
    }
};

/// Twice the middle of a segment.
glm::dvec3 twiceMiddle(const KeySegment& segment)
{
    return segment.first + segment.second;
}

constexpr int Slabs = 16;

/// Slabs of equal width along an axis, by middles.
std::array<Box, Slabs> cutIntoSlabs(const KeySegment* begin, const KeySegment* end, int axis,
                                    double low, double high)
{
    std::array<Box, Slabs> slabs;
    for (const KeySegment* segment = begin; segment != end; ++segment)
    {
        const double share = (twiceMiddle(*segment)[axis] - low) / (high - low);
        slabs[std::size_t(std::clamp(int(share * Slabs), 0, Slabs - 1))].add(*segment);
    }
    return slabs;
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
        build(0, static_cast<std::uint32_t>(_segments.size()), 1);
    }
}

// Into two parts of at most `most` segments. Where slabs along no axis promise less than halves do,
// into halves along the longest one.
std::uint32_t KeyTree::split(std::uint32_t begin, std::uint32_t end, std::uint32_t most)
{
    const std::uint32_t count = end - begin;
    glm::dvec3 low(infinity), high(-infinity);
    for (std::uint32_t i = begin; i < end; ++i)
    {
        low = glm::min(low, twiceMiddle(_segments[i]));
        high = glm::max(high, twiceMiddle(_segments[i]));
    }
    const glm::dvec3 extent = high - low;
    int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    // Whole leaves on the left, so that few are half empty.
    const auto wholeLeaves = [&](std::uint32_t number)
    { return count > LeafSize ? (number + LeafSize - 1) / LeafSize * LeafSize : number; };
    std::uint32_t left = wholeLeaves((count + 1) / 2);
    double best = infinity;
    for (int each = 0; each < 3; ++each)
    {
        if (!(extent[each] > 0.0))
            continue;
        const std::array<Box, Slabs> slabs =
            cutIntoSlabs(&_segments[begin], &_segments[begin] + count, each, low[each], high[each]);
        std::array<double, Slabs> behind; // of this slab and all behind it
        Box sum;
        for (int i = Slabs; i-- > 0;)
        {
            sum.add(slabs[std::size_t(i)]);
            behind[std::size_t(i)] = sum.cost();
        }
        sum = Box();
        for (std::size_t i = 1; i < Slabs; ++i)
        {
            sum.add(slabs[i - 1]);
            const std::uint32_t number = wholeLeaves(sum.count);
            const double cost = sum.cost() + behind[i];
            // A thin slice off a long range makes a deep tree, which other rays pay for.
            if (cost < best && 8 * number >= count && 8 * number <= 7 * count && number < count &&
                number <= most && count - number <= most)
            {
                best = cost;
                axis = each;
                left = number;
            }
        }
    }
    const auto at = _segments.begin();
    std::nth_element(at + begin, at + begin + left, at + end,
                     [axis](const KeySegment& a, const KeySegment& b)
                     { return twiceMiddle(a)[axis] < twiceMiddle(b)[axis]; });
    return begin + left;
}

KeyTree::Node::Child KeyTree::makeChild(std::uint32_t begin, std::uint32_t end, int depth)
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
        child.first = build(begin, end, depth);
    return child;
}

std::uint32_t KeyTree::build(std::uint32_t begin, std::uint32_t end, int depth)
{
    const auto index = static_cast<std::uint32_t>(_nodes.size());
    _nodes.emplace_back();
    // What fits below a child of this node.
    const std::uint32_t most = LeafSize << (2 * (MaxDepth - depth));
    const std::uint32_t middle = split(begin, end, 2 * most);
    std::array<std::pair<std::uint32_t, std::uint32_t>, 4> parts;
    std::uint32_t used = 0;
    for (const auto& [from, to] : {std::pair(begin, middle), std::pair(middle, end)})
    {
        if (to - from <= LeafSize)
            parts[used++] = {from, to};
        else
        {
            const std::uint32_t quarter = split(from, to, most);
            parts[used++] = {from, quarter};
            parts[used++] = {quarter, to};
        }
    }
    for (std::uint32_t i = 0; i < used; ++i)
    {
        // Not in one expression: building a child moves the nodes.
        const Node::Child child = makeChild(parts[i].first, parts[i].second, depth + 1);
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
