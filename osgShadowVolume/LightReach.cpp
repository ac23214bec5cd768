// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightReach.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgShadowVolume
{

double attenuationAt(const EyeLight& light, double distance)
{
    const double denominator =
        light.constantAttenuation +
        distance * (light.linearAttenuation + light.quadraticAttenuation * distance);
    return denominator > 0.0 ? std::min(1.0 / denominator, 1e30) : 1e30;
}

double brightness(const EyeLight& light)
{
    // GL allows negative intensities: such a light takes away.
    const glm::vec3 sum =
        glm::abs(light.ambient) + glm::abs(light.diffuse) + glm::abs(light.specular);
    const double most = std::max({double(sum.x), double(sum.y), double(sum.z)});
    return std::isnan(sum.x + sum.y + sum.z) ? std::numeric_limits<double>::quiet_NaN() : most;
}

double reachOf(const EyeLight& light, double threshold)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double bright = brightness(light);
    if (bright == 0.0)
        return 0.0;
    // Written so that NaN in any parameter means "reaches everything".
    if (light.isDirectional() || !(threshold > 0.0) || !(light.linearAttenuation >= 0.0f) ||
        !(light.quadraticAttenuation >= 0.0f))
        return infinity;
    const double a = light.quadraticAttenuation, b = light.linearAttenuation;
    const double c = light.constantAttenuation - bright / threshold; // a d² + b d + c = 0
    if (c >= 0.0)
        return 0.0;
    if (a > 0.0)
    {
        // The citardauq form: exact for a tiny beside b.
        const double root = std::sqrt(b * b - 4.0 * a * c);
        return std::isfinite(root) ? -2.0 * c / (b + root) : infinity;
    }
    return b > 0.0 ? -c / b : infinity;
}

bool reaches(const EyeLight& light, double reach, const glm::dvec3& center, double radius)
{
    if (reach == 0.0)
        return false;
    if (light.isDirectional())
        return true;
    const glm::dvec3 d = center - light.position;
    const double distance = glm::length(d);
    if (distance > reach + radius)
        return false;
    if (light.type == EyeLight::Point || distance <= radius || light.spotCutoffDegrees >= 90.0f)
        return true;
    // Angle between axis and centre against cutoff plus the sphere's angular radius.
    const double along = glm::dot(d, light.spotDirection);
    const double angle = std::acos(std::clamp(along / distance, -1.0, 1.0));
    const double sphere = std::asin(std::min(radius / distance, 1.0));
    return angle <= glm::radians(double(light.spotCutoffDegrees)) + sphere + 1e-6;
}

double thresholdFor(const std::vector<EyeLight>& lights, const std::vector<glm::dvec3>& points,
                    double budget)
{
    if (points.empty() || lights.empty())
        return 0.0;
    constexpr std::size_t maxSample = 4096;
    const std::size_t step = std::max<std::size_t>(1, (lights.size() + maxSample - 1) / maxSample);
    double threshold = std::numeric_limits<double>::max();
    std::vector<double> added;
    for (const glm::dvec3& point : points)
    {
        added.clear();
        for (std::size_t i = 0; i < lights.size(); i += step)
            if (!lights[i].isDirectional())
                added.push_back(brightness(lights[i]) *
                                attenuationAt(lights[i], glm::length(point - lights[i].position)));
        std::sort(added.begin(), added.end());
        double sum = 0.0, last = added.empty() ? threshold : added.back();
        for (double value : added)
        {
            sum += value * double(step);
            if (!(sum <= budget))
            {
                last = value;
                break;
            }
        }
        threshold = std::min(threshold, last);
    }
    // A reach is where the light adds exactly the threshold: stay on the safe side of `last`.
    return threshold * 0.999;
}

} // namespace osgShadowVolume
