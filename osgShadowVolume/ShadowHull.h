// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace osgShadowVolume
{

/// Eight corners in eye coordinates; bits 0, 1 and 2 of the index choose the side in x, y and z.
/// It may be flat, or not finite, which stands for an unknown extent.
using Hexahedron = std::array<glm::dvec3, 8>;

/// What a projection shows, perspective or orthographic, of any asymmetry and handedness. Not
/// finite where the matrix has no inverse (near = 0) or where its far plane is infinite, or so far
/// that a double does not hold it: 1e9 times the near distance.
OSGSHADOWVOLUME_EXPORT Hexahedron frustumOf(const glm::dmat4& projection);

/// The near rectangle of a projection: a flat hexahedron, not finite where there is none.
OSGSHADOWVOLUME_EXPORT Hexahedron nearRectangleOf(const glm::dmat4& projection);

/// A local box seen through an affine modelview. Not finite where `low` is above `high`, which is
/// how an unknown box is written, or where the matrix is not affine.
OSGSHADOWVOLUME_EXPORT Hexahedron boxOf(const glm::dvec3& low, const glm::dvec3& high,
                                        const glm::dmat4& modelview);

/// The convex hull of a hexahedron and a light: all that lies between the light and a point of it.
///
/// Of a view frustum, or of the box of the surfaces in view, it says which casters matter. Of the
/// near rectangle it says which need z-fail: the volume of a caster outside of it neither holds nor
/// cuts the near rectangle, so that z-pass is right, drawn with clipping (depth clamp would count
/// what lies before the near plane too).
///
/// It is never built: a caster lies outside where one of the directions that its faces may have
/// separates the two, and no direction can do so wrongly, however degenerate its origin.
class OSGSHADOWVOLUME_EXPORT ShadowHull
{
public:
    /// Distance in parts of the largest eye coordinate up to which a caster counts as touching:
    /// eight times what a float rounds, since volumes are drawn in float.
    static constexpr double Margin = 1e-6;

    /// `light` in eye coordinates: a position, or with w = 0 the direction towards the light. A
    /// light that is not finite or has no direction, and an unknown hexahedron, touch everything.
    ShadowHull(const Hexahedron& hexahedron, const glm::dvec4& light);

    /// Whether a caster within `box` may throw its shadow on a point of the hexahedron. Never false
    /// for one that does; an unknown box always may.
    bool mayTouch(const Hexahedron& box) const;

    /// Whether every box touches, because the hexahedron or the light is unknown.
    bool touchesEverything() const { return _axes.empty(); }

private:
    /// A direction, and where the hexahedron and the light lie along it.
    struct Axis
    {
        glm::dvec3 direction;
        double low, high;
        double light; ///< Along it, per unit of w where the light is at infinity.
    };

    Axis axisAlong(const glm::dvec3& unit) const;
    void add(const glm::dvec3& first, const glm::dvec3& second);
    void addEdge(const glm::dvec3& way);
    double shareTowardsLight(const Hexahedron& box) const;
    enum class Relation
    {
        Apart,
        Across,
        Within ///< The middle of the box is.
    };
    Relation along(const Axis& axis, const Hexahedron& box, double share, double margin) const;
    bool isApartByEdges(const Hexahedron& box, double share, double margin) const;

    Hexahedron _corners; ///< Relative to _origin, as all coordinates below.
    glm::dvec3 _origin;
    glm::dvec3 _light{0.0}; ///< Or the unit direction towards it.
    bool _isAtInfinity = false;
    double _extent = 0.0; ///< The largest coordinate, in eye coordinates.
    Axis _towards{};      ///< From the middle of the hexahedron to the light.
    std::vector<Axis> _axes;
    std::vector<glm::dvec3> _edges; ///< Of the hull, unit vectors, each direction once.
};

} // namespace osgShadowVolume
