// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixShares.h>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

namespace
{

constexpr double MostPlaces = 4096.0;

bool isFinite(const MixPart& part)
{
    const double sum = part.size + part.box.radius() + glm::length(part.box.center);
    return std::isfinite(sum);
}

/// The mean weights over the box: in the middles of its parts.
std::vector<double> meanOver(const KeyPoints& points, const MixWeights& weights, const MixBox& box,
                             int places)
{
    std::vector<double> sum(weights.getRanges().size(), 0.0);
    const auto at = [&](int i) { return (2.0 * i + 1.0) / places - 1.0; };
    for (int x = 0; x < places; ++x)
        for (int y = 0; y < places; ++y)
            for (int z = 0; z < places; ++z)
            {
                const glm::dvec3 place = box.center + at(x) * box.halfAxes[0] +
                                         at(y) * box.halfAxes[1] + at(z) * box.halfAxes[2];
                const std::vector<double> here = weights.at(points.distance(place));
                for (std::size_t i = 0; i < sum.size(); ++i)
                    sum[i] += here[i];
            }
    for (double& each : sum)
        each /= std::pow(places, 3.0);
    return sum;
}

} // namespace

std::vector<double> sharesOf(const KeyPoints& points, const MixWeights& weights,
                             const std::vector<MixPart>& parts)
{
    std::vector<double> shares(weights.getRanges().size(), 0.0);
    const double each = MostPlaces / double(std::max<std::size_t>(parts.size(), 1));
    const int places = std::clamp(int(std::cbrt(each)), 1, 12);
    double sizes = 0.0;
    for (const MixPart& part : parts)
    {
        if (!isFinite(part))
            continue;
        const std::vector<double> mean = meanOver(points, weights, part.box, places);
        for (std::size_t i = 0; i < shares.size(); ++i)
            shares[i] += part.size * mean[i];
        sizes += part.size;
    }
    for (double& share : shares)
        share = sizes > 0.0 ? share / sizes : 1.0;
    return shares;
}

} // namespace osgMultiRender
