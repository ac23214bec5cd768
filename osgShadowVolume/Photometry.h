// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>
#include <osgShadowVolume/LightReach.h>

#include <osg/LightSource>
#include <osg/Matrix>

#include <string>

/// Direct illuminance: what arrives from the lights on a straight way. What surfaces reflect onto
/// each other is left out, so a real room is brighter.
namespace osgShadowVolume
{

/// A quantity that a scene states, or why it is unknown.
struct Stated
{
    double value = -1.0;    ///< Negative while unknown.
    std::string error;      ///< One clause on an unknown value: "it states no candela=<number>".
    bool isMissing = false; ///< Nothing is stated, rightly or wrongly.

    bool isKnown() const { return value >= 0.0; }
};

/// What a light gives off: candela on the axis of a point or spot light, lux on a surface that
/// faces a directional one.
///
/// Stated as `candela`, `lumen` (divided evenly over the sphere, or over the cone with the light's
/// fall-off) or `lux`, in this order of places: user values (numbers or strings), descriptions
/// ("candela=1200"), names (DEF lamp_candela=1200), each of the LightSource and then of its Light.
OSGSHADOWVOLUME_EXPORT Stated intensityOf(const osg::LightSource& source);

/// Metres that a unit of world coordinates stands for.
///
/// Stated as `metresPerUnit`, a user value, a description ("metresPerUnit=0.001") or a part of the
/// name of the node; else of the nodes below, which must agree; else of the nearest ones above.
OSGSHADOWVOLUME_EXPORT Stated metresPerUnitOf(const osg::Node& scene);

/// How a message names a light: "light 3 'desk lamp'".
OSGSHADOWVOLUME_EXPORT std::string describeLight(const osg::Light& light);

/// What the intensity on the axis is multiplied by to give the luminous flux: the integral of
/// cos^exponent over the cone, in steradian. `cutoffDegrees` is 0 to
/// 90, or 180 for a point light.
OSGSHADOWVOLUME_EXPORT double coneOf(double cutoffDegrees, double exponent);

/// Lux on a surface element with a unit normal at `position`, in the light's coordinates, without
/// shadows: the inverse square law, Lambert's cosine, and cos^exponent within a spot's cutoff.
/// 0 at the light itself, which lies in no direction. The light's luxAtUnit must be known.
OSGSHADOWVOLUME_EXPORT double illuminanceAt(const EyeLight& light, const glm::dvec3& position,
                                            const glm::dvec3& normal);

} // namespace osgShadowVolume
