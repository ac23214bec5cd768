// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace osgMultiRender
{

/// A piece of a polyline, or a point where both ends are equal.
struct KeySegment
{
    glm::dvec3 first{0.0};
    glm::dvec3 second{0.0};

    OSGMULTIRENDER_EXPORT double distance(const glm::dvec3& point) const;
};

/// Segments in a tree of boxes, four children a node, that finds the distance to the nearest one.
///
/// Free of OSG and GL. The result is that of looking at all segments, to the last bit. Boxes are
/// cut where what is left of them is least, but never so that a walk needs more than MaxStack
/// places, whatever lies where.
class OSGMULTIRENDER_EXPORT KeyTree
{
public:
    static constexpr std::uint32_t LeafSize = 4; ///< Segments in a leaf, 1 to this.
    static constexpr int MaxStack = 32;          ///< Enough for 4^10 leaves.

    struct Node
    {
        struct Child
        {
            glm::dvec3 low{0.0}, high{0.0};
            std::uint32_t first = 0; ///< Index of a node, or of a leaf's first segment.
            std::uint32_t count = 0; ///< Segments of a leaf; 0 for a node.
        };
        std::array<Child, 4> children; ///< Without segments behind `used`.
        std::uint32_t used = 0;        ///< 2 to 4.
    };

    KeyTree() = default;
    /// Coordinates are finite and their squares are, too; KeyPoints sees to it. At most 2^20.
    explicit KeyTree(std::vector<KeySegment> segments);

    /// Infinity for a tree without segments and for a point that is not a number.
    double distance(const glm::dvec3& point) const;

    /// In the order of the leaves.
    const std::vector<KeySegment>& getSegments() const { return _segments; }
    /// The root first; empty where one leaf would do.
    const std::vector<Node>& getNodes() const { return _nodes; }

private:
    static constexpr int MaxDepth = 10; ///< Of nodes: a walk leaves three children waiting in each.

    std::uint32_t build(std::uint32_t begin, std::uint32_t end, int depth);
    std::uint32_t split(std::uint32_t begin, std::uint32_t end, std::uint32_t most);
    Node::Child makeChild(std::uint32_t begin, std::uint32_t end, int depth);

    double _slack = 1.0; ///< Of the distance to a box.
    std::vector<KeySegment> _segments;
    std::vector<Node> _nodes;
};

} // namespace osgMultiRender
