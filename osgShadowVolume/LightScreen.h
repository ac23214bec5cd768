// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>

#include <optional>

namespace osgShadowVolume
{

/// A sphere in eye coordinates; an infinite radius holds everything.
struct EyeSphere
{
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

/// The sphere around all that a light with this reach lights: for a spot that of its cone, capped
/// at the reach.
OSGSHADOWVOLUME_EXPORT EyeSphere sphereOf(const EyeLight& light, double reach);

/// Where a light can be seen to light anything.
struct ScreenBounds
{
    int x = 0, y = 0, width = 0, height = 0; ///< In pixels of the window, as glScissor takes them.
    /// Window depth for a depth range of 0 to 1. Polygon offset of the surfaces is not in it.
    double nearDepth = 0.0, farDepth = 1.0;
};

/// The pixels of the viewport (x, y, width, height) and their depths that may show a point of the
/// sphere; none where it is off screen. Covers it for certain: one pixel and 4e-6 of depth are
/// added to all sides for what the GPU rounds. What is not finite covers everything.
OSGSHADOWVOLUME_EXPORT std::optional<ScreenBounds>
screenBounds(const EyeSphere& sphere, const glm::dmat4& projection, const glm::dvec4& viewport);

/// Whether all shadows of the light hide behind their casters: a positional light at the eye of a
/// perspective view, or a directional one from where an orthographic view is seen. What shows of
/// them is narrower than half a pixel, however far behind the caster the shadow falls.
///
/// Casters before the near plane are not in the picture and still throw shadows: the light needs
/// none only where none of them touches the ShadowHull of the near rectangle.
OSGSHADOWVOLUME_EXPORT bool hidesItsShadows(const EyeLight& light, const glm::dmat4& projection,
                                            const glm::dvec4& viewport);

} // namespace osgShadowVolume
