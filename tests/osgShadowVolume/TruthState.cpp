// SPDX-License-Identifier: MIT
#include "TruthState.h"

#include <osg/BoundingBox>

#include <algorithm>
#include <cmath>
#include <limits>

namespace truth
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// What Embree is asked with: `visit` is called for each triangle that the ray may meet, until it
/// returns true.
struct Query : RTCIntersectContext
{
    bool (*visit)(const void* what, int triangle);
    const void* what;
};

void occluded(const RTCOccludedFunctionNArguments* arguments)
{
    const Query& query = *static_cast<const Query*>(arguments->context);
    if (arguments->valid[0] && query.visit(query.what, static_cast<int>(arguments->primID)))
        RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
}

RTCRay makeRay(const osg::Vec3d& origin, const osg::Vec3d& direction, double length)
{
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x());
    ray.org_y = static_cast<float>(origin.y());
    ray.org_z = static_cast<float>(origin.z());
    ray.dir_x = static_cast<float>(direction.x());
    ray.dir_y = static_cast<float>(direction.y());
    ray.dir_z = static_cast<float>(direction.z());
    ray.tfar = static_cast<float>(length);
    ray.mask = ~0u;
    return ray;
}

} // namespace

double largest(const osg::Vec3d& v)
{
    return std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
}

EyeTriangle::EyeTriangle(const osg::Vec3d (&corners)[3], const osg::Matrixd& projection)
    : screenLow(Infinity, Infinity), screenHigh(-Infinity, -Infinity)
{
    std::copy_n(corners, 3, corner);
    normal = (corner[1] - corner[0]) ^ (corner[2] - corner[0]);
    normalLength = normal.length();
    middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    radius = 0.0;
    for (int k = 0; k < 3; ++k)
    {
        const osg::Vec3d& next = corner[(k + 1) % 3];
        edgeLength[k] = (next - corner[k]).length();
        largestOfEdge[k] = std::max(largest(corner[k]), largest(next));
        radius = std::max(radius, (corner[k] - middle).length() + 1e-12 * largestOfEdge[k]);
        const osg::Vec4d clip = osg::Vec4d(corner[k], 1.0) * projection;
        for (int i = 0; i < 2; ++i)
        {
            screenLow[i] = std::min(screenLow[i], clip.w() > 0.0 ? clip[i] / clip.w() : -Infinity);
            screenHigh[i] = std::max(screenHigh[i], clip.w() > 0.0 ? clip[i] / clip.w() : Infinity);
        }
    }
}

bool meets(const EyeTriangle& t, const osg::Vec3d& origin, const osg::Vec3d& unit)
{
    const double reach = largest(origin);
    double low = 0.0, high = 0.0;
    for (int k = 0; k < 3; ++k)
    {
        const osg::Vec3d a = t.corner[k] - origin, b = t.corner[(k + 1) % 3] - origin;
        // The moment of the edge about the line, less what its rounding may be.
        const double moment = unit * (a ^ b);
        const double slack = 1e-14 * std::max(t.largestOfEdge[k], reach) * t.edgeLength[k];
        low = std::min(low, moment + slack);
        high = std::max(high, moment - slack);
    }
    return !(low < 0.0 && high > 0.0);
}

ShadowTruth::State::State(osg::Node& node, const support::CameraSpec& camera)
    : scene(node, camera.view), view(camera.view), projection(camera.projection),
      unproject(osg::Matrixd::inverse(camera.projection))
{
    for (const Triangle& triangle : scene.triangles)
    {
        const osg::Matrixd toEye = scene.frames[triangle.frame].toWorld * view;
        osg::Vec3d corners[3];
        for (int k = 0; k < 3; ++k)
            corners[k] = osg::Vec3d(triangle.local[k]) * toEye;
        triangles.emplace_back(corners, projection);
    }
    build();
}

ShadowTruth::State::~State()
{
    rtcReleaseScene(_embree);
    rtcReleaseDevice(_device);
}

void ShadowTruth::State::build()
{
    double size = 0.0;
    for (const EyeTriangle& triangle : triangles)
        for (double edge : triangle.largestOfEdge)
            size = std::max(size, edge);
    // Rays and boxes are floats: off by 2^-24 each, of a size that is no larger than the scene's.
    _bounds = {&triangles, 1e-6 * size};
    _device = rtcNewDevice("threads=1");
    _embree = rtcNewScene(_device);
    rtcSetSceneFlags(_embree, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(_device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(triangles.size()));
    rtcSetGeometryUserData(geometry, &_bounds);
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(_embree, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(_embree);
}

void ShadowTruth::State::boundsOf(const RTCBoundsFunctionArguments* arguments)
{
    const Bounds& bounds = *static_cast<const Bounds*>(arguments->geometryUserPtr);
    osg::BoundingBoxd box;
    for (const osg::Vec3d& corner : (*bounds.triangles)[arguments->primID].corner)
        box.expandBy(corner);
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = static_cast<float>(box.xMin() - bounds.slack);
    out.lower_y = static_cast<float>(box.yMin() - bounds.slack);
    out.lower_z = static_cast<float>(box.zMin() - bounds.slack);
    out.upper_x = static_cast<float>(box.xMax() + bounds.slack);
    out.upper_y = static_cast<float>(box.yMax() + bounds.slack);
    out.upper_z = static_cast<float>(box.zMax() + bounds.slack);
}

bool ShadowTruth::State::ask(const osg::Vec3d& origin, const osg::Vec3d& direction, double length,
                             Visit toVisit, const void* what) const
{
    Query query;
    rtcInitIntersectContext(&query);
    query.visit = toVisit;
    query.what = what;
    RTCRay ray = makeRay(origin, direction, length);
    rtcOccluded1(_embree, &query, &ray);
    return ray.tfar < 0.0f;
}

EyeLight ShadowTruth::State::toEye(const Light& light) const
{
    const osg::Vec4d& p = light.position;
    const SidesKey key = {p.x(), p.y(), p.z(), p.w(), double(light.sideIfNear)};
    std::lock_guard<std::mutex> lock(_mutex);
    auto& sides = _sides[key];
    if (!sides)
    {
        auto found = std::make_shared<std::vector<signed char>>();
        for (const Triangle& triangle : scene.triangles)
            found->push_back(
                static_cast<signed char>(sideOf(triangle, scene.frames[triangle.frame], light)));
        sides = std::move(found);
    }
    return {p * view, osg::Matrixd::transform3x3(light.direction, view), light.cosCutoff, sides};
}

EyeRay ShadowTruth::State::rayAt(double x, double y) const
{
    const osg::Vec3d origin = osg::Vec3d(x, y, -1.0) * unproject;
    const osg::Vec3d direction = osg::Vec3d(x, y, 1.0) * unproject - origin;
    return {origin, direction, direction / direction.length()};
}

bool ShadowTruth::State::isCulled(int triangle, const EyeRay& ray) const
{
    const Culled culled = scene.triangles[triangle].culled;
    if (culled == Culled::NONE || culled == Culled::BOTH)
        return culled == Culled::BOTH;
    const bool front = triangles[triangle].normal * ray.direction < 0.0;
    return front == (culled == Culled::FRONT);
}

double ShadowTruth::State::along(int triangle, const EyeRay& ray) const
{
    const EyeTriangle& t = triangles[triangle];
    return (t.normal * (t.corner[0] - ray.origin)) / (t.normal * ray.direction);
}

Sample ShadowTruth::State::hitAt(int triangle, const EyeRay& ray) const
{
    Sample sample;
    sample.triangle = triangle;
    sample.normal = triangles[triangle].normal;
    sample.normal.normalize();
    sample.point = ray.origin + ray.direction * along(triangle, ray);
    return sample;
}

/// Keeps the nearer one of a triangle and what was found before.
void ShadowTruth::State::meet(int triangle, const EyeRay& ray, int& found, double& nearest) const
{
    const double distance = along(triangle, ray);
    if (!(distance >= 0.0 && distance <= 1.0 && distance < nearest) || isCulled(triangle, ray) ||
        !meets(triangles[triangle], ray.origin, ray.unit))
        return;
    nearest = distance;
    found = triangle;
}

Sample ShadowTruth::State::firstHit(const EyeRay& ray) const
{
    double nearest = std::numeric_limits<double>::infinity();
    int found = -1;
    visit(ray.origin, ray.direction, 1.00001,
          [&](int triangle)
          {
              meet(triangle, ray, found, nearest);
              return false;
          });
    return found < 0 ? Sample() : hitAt(found, ray);
}

Sample ShadowTruth::State::firstHitOfAll(const EyeRay& ray) const
{
    double nearest = std::numeric_limits<double>::infinity();
    int found = -1;
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i)
        meet(i, ray, found, nearest);
    return found < 0 ? Sample() : hitAt(found, ray);
}

bool ShadowTruth::State::castsOnItself(int triangle, const EyeLight& light, const EyeRay& ray) const
{
    const int side = (*light.sides)[triangle];
    return side != 0 && (triangles[triangle].normal * ray.direction > 0.0) == (side > 0);
}

bool ShadowTruth::State::areSame(int a, int b) const
{
    for (const osg::Vec3d& corner : triangles[a].corner)
    {
        const auto& other = triangles[b].corner;
        if (std::find(other, other + 3, corner) == other + 3)
            return false;
    }
    return true;
}

bool ShadowTruth::State::casts(int caster, const EyeLight& light, const osg::Vec3d& point,
                               const osg::Vec3d& toLight) const
{
    const int side = (*light.sides)[caster];
    const EyeTriangle& e = triangles[caster];
    const double height = (point - e.corner[0]) * e.normal / e.normalLength;
    // A point that lies in the plane by the precision of double is that of a coplanar surface,
    // which casts on itself or not, as that surface does.
    const double rounding = 1e-13 * std::max(largest(point), largest(e.corner[0]));
    if (side == 0 || !(std::abs(height) > rounding) || (height > 0.0) == (side > 0))
        return false;
    return meets(e, point, toLight);
}

template <class IsLeftOut>
bool ShadowTruth::State::isOccludedBut(const EyeLight& light, const osg::Vec3d& point,
                                       const IsLeftOut& isLeftOut) const
{
    osg::Vec3d toLight = light.from(point);
    const double distance = toLight.normalize();
    const double length = light.position.w() == 0.0 ? Infinity : distance * 1.00001;
    return visit(point, toLight, length,
                 [&](int triangle)
                 { return !isLeftOut(triangle) && casts(triangle, light, point, toLight); });
}

bool ShadowTruth::State::isOccluded(const EyeLight& light, const osg::Vec3d& point, int seen) const
{
    return isOccludedBut(light, point, [&](int triangle) { return triangle == seen; });
}

bool ShadowTruth::State::isOccludedByOthers(const EyeLight& light, const osg::Vec3d& point,
                                            int seen) const
{
    return isOccludedBut(light, point, [&](int triangle) { return areSame(triangle, seen); });
}

bool ShadowTruth::State::isOccludedByAny(const EyeLight& light, const osg::Vec3d& point,
                                         int seen) const
{
    osg::Vec3d toLight = light.from(point);
    toLight.normalize();
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i)
        if (i != seen && casts(i, light, point, toLight))
            return true;
    return false;
}

Seen ShadowTruth::State::judge(const EyeLight& light, const EyeRay& ray, Sample& sample,
                               Occluded isInShadow) const
{
    if (sample.triangle < 0)
        return Seen::NOTHING;
    osg::Vec3d toLight = light.from(sample.point);
    toLight.normalize();
    sample.grazing = std::abs(toLight * sample.normal);
    if (-(toLight * light.direction) < light.cosCutoff)
        return Seen::UNREACHED;
    if (castsOnItself(sample.triangle, light, ray))
        return Seen::SHADOWED;
    return (this->*isInShadow)(light, sample.point, sample.triangle) ? Seen::SHADOWED : Seen::LIT;
}

Sample ShadowTruth::State::sample(const EyeLight& light, const EyeRay& ray) const
{
    Sample sample = firstHit(ray);
    sample.seen = judge(light, ray, sample);
    return sample;
}

} // namespace truth
