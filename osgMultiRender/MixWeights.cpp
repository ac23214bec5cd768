// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixWeights.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace osgMultiRender
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Beyond it a distance is as good as infinite, and sums and differences stay finite.
constexpr double limit = 1e30;

double toLimit(double distance)
{
    return distance > limit ? infinity : distance < -limit ? -infinity : distance;
}

/// Of a settled range; `side` -1 and 1 for the limits from below and above.
double weightBeside(const MixRange& range, double distance, int side)
{
    if (range.dr1 == infinity)
        return 0.0;
    if (distance < range.dr1 || (distance == range.dr1 && side < 0))
        return range.dr0 < range.dr1
                   ? std::clamp((distance - range.dr0) / (range.dr1 - range.dr0), 0.0, 1.0)
                   : 0.0;
    if (distance > range.dr2 || (distance == range.dr2 && side > 0))
        return range.dr2 < range.dr3
                   ? std::clamp((range.dr3 - distance) / (range.dr3 - range.dr2), 0.0, 1.0)
                   : 0.0;
    return 1.0;
}

void include(std::vector<MixWeights::Bounds>& bounds, const std::vector<double>& weights)
{
    for (std::size_t i = 0; i < bounds.size(); ++i)
    {
        bounds[i].low = std::min(bounds[i].low, weights[i]);
        bounds[i].high = std::max(bounds[i].high, weights[i]);
    }
}

double sumOf(const std::vector<double>& weights)
{
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

} // namespace

MixRange MixRange::settled() const
{
    if (std::isnan(dr0) || std::isnan(dr1) || std::isnan(dr2) || std::isnan(dr3))
        return {infinity, infinity, infinity, infinity};
    MixRange range;
    range.dr0 = toLimit(dr0);
    range.dr1 = std::max(range.dr0, toLimit(dr1));
    range.dr2 = std::max(range.dr1, toLimit(dr2));
    range.dr3 = std::max(range.dr2, toLimit(dr3));
    // A slope without end is its limit: 0 before an infinite maximum, 1 after an infinite begin.
    if (range.dr1 == infinity)
        range.dr0 = infinity;
    if (range.dr0 == -infinity)
        range.dr1 = -infinity;
    if (range.dr2 == -infinity)
        range.dr2 = range.dr3;
    if (range.dr3 == infinity)
        range.dr2 = infinity;
    return range;
}

double MixRange::weight(double distance) const
{
    return weightBeside(settled(), std::isnan(distance) ? infinity : distance, 0);
}

MixWeights::MixWeights(const std::vector<MixRange>& ranges, const MixRules& rules) : _rules(rules)
{
    for (const MixRange& range : ranges)
    {
        _ranges.push_back(range.settled());
        const MixRange& settled = _ranges.back();
        for (const double at : {settled.dr0, settled.dr1, settled.dr2, settled.dr3})
            if (std::isfinite(at))
                _breaks.push_back(at);
    }
    std::sort(_breaks.begin(), _breaks.end());
    _breaks.erase(std::unique(_breaks.begin(), _breaks.end()), _breaks.end());
    if (rules.base < 0 || static_cast<std::size_t>(rules.base) >= ranges.size())
        _rules.base = -1;
}

std::vector<double> MixWeights::raw(double distance, int side) const
{
    std::vector<double> weights;
    weights.reserve(_ranges.size() + 1);
    for (const MixRange& range : _ranges)
        weights.push_back(weightBeside(range, distance, side));
    return weights;
}

std::vector<double> MixWeights::applyRules(std::vector<double> weights) const
{
    const double sum = sumOf(weights), missing = std::max(0.0, 1.0 - sum);
    if (_rules.excess == MixRules::Excess::Normalise && sum > 1.0)
        for (double& weight : weights)
            weight /= sum;
    if (_rules.base >= 0)
        weights[static_cast<std::size_t>(_rules.base)] += missing;
    weights.push_back(_rules.base >= 0 ? 0.0 : missing);
    return weights;
}

std::vector<double> MixWeights::at(double distance) const
{
    return applyRules(raw(std::isnan(distance) ? infinity : distance, 0));
}

std::vector<MixWeights::Bounds> MixWeights::over(double nearest, double farthest) const
{
    if (!(nearest <= farthest))
        return std::vector<Bounds>(_ranges.size() + 1, {0.0, 1.0});
    std::vector<Bounds> bounds(_ranges.size() + 1, {infinity, -infinity});
    std::vector<double> points{nearest};
    std::copy(std::upper_bound(_breaks.begin(), _breaks.end(), nearest),
              std::lower_bound(_breaks.begin(), _breaks.end(), farthest),
              std::back_inserter(points));
    if (farthest > nearest)
        points.push_back(farthest);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        include(bounds, at(points[i]));
        if (i + 1 == points.size())
            break;
        // Within a piece all are linear in the distance, and monotonic after normalisation: the
        // extremes lie at its ends, or where the sum passes 1.
        std::vector<double> from = raw(points[i], 1);
        const std::vector<double> to = raw(points[i + 1], -1);
        const double excess = sumOf(from) - 1.0, excessAfter = sumOf(to) - 1.0;
        include(bounds, applyRules(from));
        include(bounds, applyRules(to));
        if ((excess < 0.0) == (excessAfter < 0.0) || excess == excessAfter)
            continue;
        const double share = excess / (excess - excessAfter);
        for (std::size_t k = 0; k < from.size(); ++k)
            from[k] += share * (to[k] - from[k]);
        include(bounds, applyRules(from));
    }
    return bounds;
}

glm::dvec4 MixWeights::mix(double distance, const std::vector<glm::dvec3>& colors) const
{
    const std::vector<double> weights = at(distance);
    const double background = weights.back() * _rules.background.a;
    glm::dvec4 sum(background * glm::dvec3(_rules.background), background);
    for (std::size_t i = 0; i < _ranges.size() && i < colors.size(); ++i)
        sum += weights[i] * glm::dvec4(colors[i], 1.0);
    return glm::clamp(sum, 0.0, 1.0);
}

} // namespace osgMultiRender
