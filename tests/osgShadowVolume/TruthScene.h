// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Light>
#include <osg/Matrixd>
#include <osg/Node>

#include <string>
#include <vector>

/// What the ray tracer knows of an OSG scene: triangles and lights, in world coordinates.
namespace truth
{

/// Which sides of a surface are not seen. All cast shadows.
enum class Culled
{
    NONE,
    BACK,
    FRONT,
    BOTH
};

/// The frame of a drawable.
struct Frame
{
    osg::Matrixd toWorld;
    osg::Matrixd fromWorld;
    int handedness = 1; ///< -1 where toWorld mirrors, 0 where it flattens.
};

struct Triangle
{
    osg::Vec3f local[3]; ///< As the drawable has them.
    unsigned int frame = 0;
    Culled culled = Culled::NONE; ///< By window winding, as GL does.
};

struct Light
{
    int number = 0;
    osg::Vec4d position;     ///< World; w is 0 for one at infinity.
    osg::Vec3d direction;    ///< World; of a spot, unit.
    double cosCutoff = -2.0; ///< -2 for no cone.
    /// The side of planes that the light is on, or off by a rounding of float; -2 for the exact
    /// one.
    int sideIfNear = -2;
};

/// Triangles of all drawables that triangles can be asked from, by the active children of the
/// scene; billboards, lines and points are left out, and so are triangles that are not finite.
struct Scene
{
    std::vector<Frame> frames;
    std::vector<Triangle> triangles;
    std::vector<Light> lights;

    /// `view` places lights that are given in eye coordinates.
    Scene(osg::Node& node, const osg::Matrixd& view);
};

/// A light in world coordinates; `toWorld` is that of its LightSource.
Light makeLight(const osg::Light& light, const osg::Matrixd& toWorld);

/// On which side of the plane of the triangle the light lies, from where it is counterclockwise: 1,
/// from where it is clockwise: -1, in the plane: 0. Exact for the light in the caster's frame; see
/// Light::sideIfNear.
int sideOf(const Triangle& triangle, const Frame& frame, const Light& light);

/// Whether the light lies on a triangle, its edges and corners too, but for the rounding of float.
/// Then the triangle spans half of all directions or more, and which half is decided by rounding.
bool touches(const Triangle& triangle, const Frame& frame, const Light& light);

} // namespace truth
