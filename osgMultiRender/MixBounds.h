// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyPoints.h>
#include <osgMultiRender/MixWeights.h>

namespace osgMultiRender
{

/// A box of any orientation, even sheared, in the frame of the key points: the bounding box of a
/// drawable with its path's matrix applied.
struct MixBox
{
    glm::dvec3 center{0.0};
    std::array<glm::dvec3, 3> halfAxes{}; ///< From the centre to the middle of a side.

    /// The box between two corners of a local frame; `matrix` leads from there to the key points.
    OSGMULTIRENDER_EXPORT static MixBox from(const glm::dvec3& low, const glm::dvec3& high,
                                             const glm::dmat4& matrix = glm::dmat4(1.0));
    OSGMULTIRENDER_EXPORT double radius() const; ///< Of the sphere around it.
};

/// Bounds of all weights over a sphere, as MixWeights::at() orders them. Never too narrow; a
/// weight that is 0 (or 1) within `radius` of the boundary of where it is so may not be proven.
///
/// `margin`, in units of the key points, is how far off a fragment's position may be: single
/// precision has it at some 1e-6 of its distance from the eye. A sphere or box that is not finite,
/// and one with a negative radius: 0 to 1 for all.
OSGMULTIRENDER_EXPORT std::vector<MixWeights::Bounds>
weightsOver(const KeyPoints& points, const MixWeights& weights, const glm::dvec3& center,
            double radius, double margin = 0.0);

/// Likewise over a box, which is halved until all weights are known to be 0 everywhere, 1
/// everywhere or neither, `maxDistances` times at most. Each costs one KeyPoints::distance().
OSGMULTIRENDER_EXPORT std::vector<MixWeights::Bounds>
weightsOver(const KeyPoints& points, const MixWeights& weights, const MixBox& box,
            double margin = 0.0, int maxDistances = 128);

} // namespace osgMultiRender
