// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace osgShadowVolume
{

/// A flat surface: the rectangle around its triangles, in their plane.
struct MirrorShape
{
    /// Counter-clockwise as seen from where most of the triangles, by area, are counter-clockwise.
    std::array<glm::dvec3, 4> corners{};
    double tolerance = 0.0; ///< How far points of the surface may lie off the plane.

    /// The same in other coordinates. `matrix` is affine.
    OSGSHADOWVOLUME_EXPORT MirrorShape transformed(const glm::dmat4& matrix) const;
};

/// The shape of triangles, three points each. Empty where they have no area or do not lie in one
/// plane; `error` then says which: "not planar". Points may lie off the plane by 1e-4 of the
/// surface's size and by what floats round.
OSGSHADOWVOLUME_EXPORT std::optional<MirrorShape>
fitMirror(const std::vector<glm::dvec3>& triangles, std::string& error);

/// Where a projection looks from, in eye coordinates: a point with w = 1, or for a parallel
/// projection the direction towards the viewer with w = 0. Does not read the depth row but for the
/// sign of a direction, so near and far may not be known yet.
OSGSHADOWVOLUME_EXPORT glm::dvec4 eyeOf(const glm::dmat4& projection);

/// The plane (unit normal, offset) of a shape, positive on the eye's side. Empty where the eye lies
/// in the plane.
OSGSHADOWVOLUME_EXPORT std::optional<glm::dvec4> planeTowards(const MirrorShape& shape,
                                                              const glm::dvec4& eye);

/// Whether the side that the triangles are counter-clockwise on is the plane's positive one.
OSGSHADOWVOLUME_EXPORT bool showsFront(const MirrorShape& shape, const glm::dvec4& plane);

/// Whether a shape lies in a plane, within the tolerances of both.
OSGSHADOWVOLUME_EXPORT bool liesIn(const MirrorShape& shape, const glm::dvec4& plane,
                                   double tolerance);

/// Takes each point to where a mirror in the plane shows it.
OSGSHADOWVOLUME_EXPORT glm::dmat4 reflectionIn(const glm::dvec4& plane);

/// Whether all of a shape is behind the viewer. Always false for a parallel projection.
OSGSHADOWVOLUME_EXPORT bool isBehind(const MirrorShape& shape, const glm::dmat4& projection);

/// The share of the picture that the rectangle covers, 0 to 1. Near and far planes do not count.
OSGSHADOWVOLUME_EXPORT double shareOfView(const MirrorShape& shape, const glm::dmat4& projection);

} // namespace osgShadowVolume
