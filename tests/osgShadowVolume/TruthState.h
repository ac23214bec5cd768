// SPDX-License-Identifier: MIT
#pragma once

#include "ShadowTruth.h"

#include <osg/Vec4d>

#include <embree3/rtcore.h>

#include <array>
#include <map>
#include <mutex>

/// The inside of ShadowTruth, for its own files.
namespace truth
{

/// From the near to the far plane.
struct EyeRay
{
    osg::Vec3d origin;
    osg::Vec3d direction; ///< Not unit: 1 is the far plane.
    osg::Vec3d unit;      ///< The same way.
};

struct EyeTriangle
{
    osg::Vec3d corner[3];
    osg::Vec3d normal;       ///< Not unit.
    double normalLength;     ///< Its length.
    double edgeLength[3];    ///< From corner k to the next one.
    double largestOfEdge[3]; ///< The largest coordinate of its ends.
    osg::Vec3d middle;
    double radius;         ///< Of a sphere around the middle that holds it.
    osg::Vec2d screenLow;  ///< Of a box on the screen, in normalized device
    osg::Vec2d screenHigh; ///< coordinates; infinite where a corner is not before the eye.

    EyeTriangle(const osg::Vec3d (&corners)[3], const osg::Matrixd& projection);

    /// Whether it may be seen in the rectangle around the center that is twice as large as `half`.
    bool isOnScreen(const osg::Vec2d& center, const osg::Vec2d& half) const
    {
        return screenLow.x() - half.x() <= center.x() && screenHigh.x() + half.x() >= center.x() &&
               screenLow.y() - half.y() <= center.y() && screenHigh.y() + half.y() >= center.y();
    }
};

/// A light in eye coordinates.
struct EyeLight
{
    osg::Vec4d position;
    osg::Vec3d direction;
    double cosCutoff;
    std::shared_ptr<const std::vector<signed char>> sides; ///< sideOf() each triangle.

    /// From the point to the light; for one at infinity of any length.
    osg::Vec3d from(const osg::Vec3d& point) const
    {
        const osg::Vec3d p(position.x(), position.y(), position.z());
        return position.w() == 0.0 ? p : p - point;
    }
};

/// The largest coordinate.
double largest(const osg::Vec3d& v);

/// Whether the line meets the triangle, or passes it within the rounding of double: between two
/// triangles with a common edge no line gets through, though they have transforms of their own.
bool meets(const EyeTriangle& t, const osg::Vec3d& origin, const osg::Vec3d& unit);

/// One quantum of a 24-bit depth buffer in normalized device coordinates, -1 to 1.
constexpr double DepthQuantum = 2.0 / (1 << 24);

struct ShadowTruth::State
{
    Scene scene;
    osg::Matrixd view, projection, unproject;
    std::vector<EyeTriangle> triangles;

    State(osg::Node& node, const support::CameraSpec& camera);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    EyeLight toEye(const Light& light) const;
    EyeRay rayAt(double x, double y) const;
    double depthOf(const osg::Vec3d& point) const { return (point * projection).z(); }
    bool isCulled(int triangle, const EyeRay& ray) const;
    /// Where the ray meets the plane of the triangle; NaN or infinity for one seen edge on.
    double along(int triangle, const EyeRay& ray) const;
    Sample hitAt(int triangle, const EyeRay& ray) const;
    Sample firstHit(const EyeRay& ray) const;
    Sample firstHitOfAll(const EyeRay& ray) const;
    bool castsOnItself(int triangle, const EyeLight& light, const EyeRay& ray) const;
    /// Whether the triangle lies between the point and the light; `toLight` is the unit way there.
    bool casts(int caster, const EyeLight& light, const osg::Vec3d& point,
               const osg::Vec3d& toLight) const;
    bool isOccluded(const EyeLight& light, const osg::Vec3d& point, int seen) const;
    /// By a triangle that has not the same corners as the one that is seen.
    bool isOccludedByOthers(const EyeLight& light, const osg::Vec3d& point, int seen) const;
    bool isOccludedByAny(const EyeLight& light, const osg::Vec3d& point, int seen) const;
    /// Whether the two have the same corners.
    bool areSame(int a, int b) const;
    using Occluded = bool (State::*)(const EyeLight&, const osg::Vec3d&, int) const;
    /// What the surface of the sample is; writes its grazing.
    Seen judge(const EyeLight& light, const EyeRay& ray, Sample& sample,
               Occluded isInShadow = &State::isOccluded) const;
    Sample sample(const EyeLight& light, const EyeRay& ray) const;

private:
    /// How far floats may be off among the triangles, for Embree.
    struct Bounds
    {
        const std::vector<EyeTriangle>* triangles;
        double slack;
    };
    template <class IsLeftOut>
    bool isOccludedBut(const EyeLight& light, const osg::Vec3d& point,
                       const IsLeftOut& isLeftOut) const;
    using Visit = bool (*)(const void* what, int triangle);

    void build();
    void meet(int triangle, const EyeRay& ray, int& found, double& nearest) const;
    static void boundsOf(const RTCBoundsFunctionArguments* arguments);
    bool ask(const osg::Vec3d& origin, const osg::Vec3d& direction, double length, Visit toVisit,
             const void* what) const;

    /// Calls what(triangle) for all triangles near the ray, which has `length` times its
    /// direction, until one returns true.
    template <class What>
    bool visit(const osg::Vec3d& origin, const osg::Vec3d& direction, double length,
               const What& what) const
    {
        return ask(
            origin, direction, length,
            [](const void* w, int triangle) { return (*static_cast<const What*>(w))(triangle); },
            &what);
    }

    using SidesKey = std::array<double, 5>; // position and Light::sideIfNear

    Bounds _bounds{};
    RTCDevice _device = nullptr;
    RTCScene _embree = nullptr;
    mutable std::mutex _mutex; ///< Of what follows.
    mutable std::map<SidesKey, std::shared_ptr<const std::vector<signed char>>> _sides;
};

} // namespace truth
