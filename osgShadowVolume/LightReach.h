// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace osgShadowVolume
{

/// One light in eye coordinates, free of OSG and GL.
struct EyeLight
{
    enum Type : std::uint8_t
    {
        Directional,
        Point,
        Spot,
        DirectionalSpot ///< At infinity, with a cone: one factor for the whole scene.
    };

    /// Whether it lies at infinity.
    bool isDirectional() const { return type == Directional || type == DirectionalSpot; }

    Type type = Directional;
    int number = 0;   ///< LightSource number, GL_LIGHT0 + number.
    std::string name; ///< For plans; may be empty.
    bool castsShadow = true;
    bool isHeadlight = false; ///< Of the viewer: placed in eye coordinates.
    glm::dvec3 position{0.0}; ///< Directional: the unit vector towards the light.
    glm::vec3 ambient{0.0f};
    glm::vec3 diffuse{0.0f};
    glm::vec3 specular{0.0f};
    float constantAttenuation = 1.0f;
    float linearAttenuation = 0.0f;
    float quadraticAttenuation = 0.0f;
    glm::dvec3 spotDirection{0.0, 0.0, -1.0}; ///< Unit vector; spots only.
    float spotCutoffDegrees = 180.0f;
    float spotExponent = 0.0f;
    /// Lux at one unit of distance on the axis, at any distance for a light at infinity; negative
    /// where the light does not say. Attenuation plays no part in it.
    double luxAtUnit = -1.0;
};

/// 1 / (c + l d + q d²); a denominator of 0 or less gives 1e30, the largest light that stays
/// finite.
OSGSHADOWVOLUME_EXPORT double attenuationAt(const EyeLight& light, double distance);

/// The most that the light changes a channel of a surface with materials up to 1, before
/// attenuation. Negative intensities count by their size.
OSGSHADOWVOLUME_EXPORT double brightness(const EyeLight& light);

/// Distance beyond which the light changes any channel by less than `threshold`; infinity where
/// there is none (directional lights, no attenuation, threshold 0), 0 for a light that never
/// reaches it.
OSGSHADOWVOLUME_EXPORT double reachOf(const EyeLight& light, double threshold);

/// Whether a light with this reach may light a point of the sphere. Never false for one that does:
/// the cone of a spot is tested against the sphere as a whole. A spot lights nothing outside its
/// cone.
OSGSHADOWVOLUME_EXPORT bool reaches(const EyeLight& light, double reach, const glm::dvec3& center,
                                    double radius);

/// The largest threshold such that, at each of the points, the lights that lie beyond their reach
/// add up to at most `budget`. Points are samples of the surfaces; of more than 4096 lights a
/// stratified sample stands for all. Returns 0 (nothing may be left out) for no points.
OSGSHADOWVOLUME_EXPORT double thresholdFor(const std::vector<EyeLight>& lights,
                                           const std::vector<glm::dvec3>& points, double budget);

} // namespace osgShadowVolume
