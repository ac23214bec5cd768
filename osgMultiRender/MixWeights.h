// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <glm/glm.hpp>

#include <limits>
#include <vector>

namespace osgMultiRender
{

/// The distances from the key points within which a rendering shows.
///
///     weight 1 ........ +--------+
///                      /          \      ...
///     weight 0 -------+            +-------
///                    dr0 dr1    dr2 dr3      distance
///
/// Any value is allowed: one that is less than the one before counts as equal to it; equal dr0 and
/// dr1, or dr2 and dr3, are a step, which belongs to the maximum; negative ones lie before all
/// distances; an infinite dr3 has the maximum reach for ever from dr1 on, and an infinite dr1 is
/// never reached (the limits of long slopes). One that is not a number: the weight is 0 everywhere.
struct OSGMULTIRENDER_EXPORT MixRange
{
    double dr0 = 0.0;
    double dr1 = 0.0;
    double dr2 = std::numeric_limits<double>::infinity();
    double dr3 = std::numeric_limits<double>::infinity();

    /// The range that counts: in order, without infinite slopes. Nowhere: all are infinite.
    MixRange settled() const;
    /// 0 to 1. An infinite distance is that without key points.
    double weight(double distance) const;
};

/// What shows where the weights add up to less or more than 1.
struct MixRules
{
    enum class Excess
    {
        Clamp,    ///< The sum of colours is clamped.
        Normalise ///< Weights are divided by their sum.
    };

    Excess excess = Excess::Clamp;
    /// The rendering that takes what is missing to 1, or -1 for the background. A number that is
    /// not that of a rendering counts as -1.
    int base = -1;
    /// Takes what is missing to 1, by its alpha. Of alpha 0, colours fade to black and alpha to 0
    /// there: black over black, transparent where the result is blended as premultiplied.
    glm::dvec4 background{0.0};
};

/// From the distance to the weights of any number of renderings. Free of OSG and GL.
///
/// Everything is a function of the distance alone, piecewise smooth between the dr, so that bounds
/// over a range of distances are exact.
class OSGMULTIRENDER_EXPORT MixWeights
{
public:
    /// Lowest and highest weight.
    struct Bounds
    {
        double low = 0.0;
        double high = 0.0;

        bool isZero() const { return high <= 0.0; } ///< Need not be drawn.
        bool isOne() const { return low >= 1.0; }
    };

    MixWeights() = default;
    explicit MixWeights(const std::vector<MixRange>& ranges, const MixRules& rules = {});

    /// One weight a rendering, by the rules; the last one more is that of the background.
    std::vector<double> at(double distance) const;

    /// As at(), over all distances of a closed range, which may be infinite. Distances that are
    /// not a number or in wrong order: 0 to 1 for all.
    std::vector<Bounds> over(double nearest, double farthest) const;

    /// The colour of a fragment whose renderings have these colours, one each: the sum of weight x
    /// colour, clamped; alpha is the sum of weights, not that of the colours.
    glm::dvec4 mix(double distance, const std::vector<glm::dvec3>& colors) const;

    const std::vector<MixRange>& getRanges() const { return _ranges; } ///< Settled.
    const MixRules& getRules() const { return _rules; }                ///< With a valid base.

private:
    /// `side`: -1 and 1 for the limits from below and above.
    std::vector<double> raw(double distance, int side) const;
    std::vector<double> applyRules(std::vector<double> weights) const;

    std::vector<MixRange> _ranges;
    MixRules _rules;
    std::vector<double> _breaks; ///< Where a slope begins or ends: sorted, finite.
};

} // namespace osgMultiRender
