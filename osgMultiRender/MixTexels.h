// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyMoves.h>
#include <osgMultiRender/MixWeights.h>

namespace osgMultiRender
{

/// Key points and weights in single precision, as shaders/mix.glsl reads them. Free of OSG and GL.
///
/// Positions are relative to the eye, after a subtraction in double precision: key points at 1e7
/// are exact where the eye is near. Axes stay those of the key points, so that the tree's boxes
/// stay boxes and the tree is not built anew when the eye moves.
struct OSGMULTIRENDER_EXPORT MixTexels
{
    /// Up to so many segments there is no tree.
    static constexpr std::size_t LinearSize = 16;

    std::vector<glm::uvec4> texels; ///< A buffer texture of RGBA32UI, sampler osgmr_mix.
    glm::mat3 frame{1.0f};          ///< Uniform osgmr_mixFrame: from eye space to the key points'.
    /// Uniform osgmr_mixKeys: the tree's root or 0; the first segment; their number; texels each.
    glm::ivec4 keys{0, 0, 0, 1};
    /// Uniform osgmr_mixRules: number of renderings; base or -1; whether to normalise; 0.
    glm::ivec4 rules{0, -1, 0, 0};
    glm::vec4 background{0.0f}; ///< Uniform osgmr_mixBackground.
    /// Behind the texels, four integers each; null: there are none. See KeyMoves.
    std::shared_ptr<const KeyCells> cells;
    /// Uniform osgmr_mixRoots: the low corners of the cells' grids, and 1 / their sizes.
    std::array<glm::vec4, 2> roots{};
    /// Uniform osgmr_mixCells: their first texel or 0; the first cells of both grids; 0.
    glm::ivec4 grids{0};
    /// Uniform osgmr_mixListed: the first of the segments that cells list; the first of those that
    /// none lists; their number; 0.
    glm::ivec4 listed{0};

    /// `keysToEye` is affine: the view matrix, after the matrix of the node that the key points
    /// are attached to. One that cannot be inverted, or is not finite, leaves no key points: every
    /// distance is infinite.
    void set(const KeyPoints& points, const MixWeights& weights, const glm::dmat4& keysToEye);

private:
    void addFloats(const glm::vec4& values);
    void addLine(const glm::dvec3& first, const glm::dvec3& second);
    void addRanges(const MixWeights& weights);
    void addSegments(const std::vector<KeySegment>& segments, const glm::dvec3& eye);
    void addNodes(const KeyTree& tree, const glm::dvec3& eye);
    void addNode(const KeyTree::Node& node, const glm::dvec3& eye);
    void addCells(const KeyPoints& points, const glm::dvec3& eye);

    KeyMoves _moves;
};

} // namespace osgMultiRender
