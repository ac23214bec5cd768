// SPDX-License-Identifier: MIT
#include "ShadowTruth.h"

#include <osg/BoundingBox>

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

namespace truth
{

namespace
{

/// From the near to the far plane.
struct EyeRay
{
    osg::Vec3d origin;
    osg::Vec3d direction; ///< Not unit: 1 is the far plane.
};

/// A light in eye coordinates.
struct EyeLight
{
    osg::Vec4d position;
    osg::Vec3d direction;
    double cosCutoff;

    /// From the point to the light; for one at infinity of any length.
    osg::Vec3d from(const osg::Vec3d& point) const
    {
        const osg::Vec3d p(position.x(), position.y(), position.z());
        return position.w() == 0.0 ? p : p - point;
    }
};

struct EyeTriangle
{
    osg::Vec3d corner[3];
    osg::Vec3d normal; ///< Not unit.
};

double largest(const osg::Vec3d& v)
{
    return std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
}

/// Whether the line meets the triangle, or passes it within the rounding of double: between two
/// triangles with a common edge no line gets through, though they have transforms of their own.
bool meets(const EyeTriangle& t, const osg::Vec3d& origin, const osg::Vec3d& direction)
{
    const osg::Vec3d d = direction / direction.length();
    double low = 0.0, high = 0.0;
    for (int k = 0; k < 3; ++k)
    {
        const osg::Vec3d a = t.corner[k] - origin, b = t.corner[(k + 1) % 3] - origin;
        const double size =
            std::max({largest(t.corner[k]), largest(t.corner[(k + 1) % 3]), largest(origin)});
        // The moment of the edge about the line, less what its rounding may be.
        const double moment = d * (a ^ b);
        const double slack = 1e-14 * size * (b - a).length();
        low = std::min(low, moment + slack);
        high = std::max(high, moment - slack);
    }
    return !(low < 0.0 && high > 0.0);
}

/// What Embree is asked with: `visit` is called for each triangle that the ray may meet, until it
/// returns true.
struct Query : RTCIntersectContext
{
    std::function<bool(int)> visit;
};

/// Corners of all triangles, and how far floats may be off among them.
struct Bounds
{
    const std::vector<EyeTriangle>* triangles;
    double slack;
};

void boundsOf(const RTCBoundsFunctionArguments* arguments)
{
    const Bounds& bounds = *static_cast<const Bounds*>(arguments->geometryUserPtr);
    const EyeTriangle& triangle = (*bounds.triangles)[arguments->primID];
    osg::BoundingBoxd box;
    for (const osg::Vec3d& corner : triangle.corner)
        box.expandBy(corner);
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = static_cast<float>(box.xMin() - bounds.slack);
    out.lower_y = static_cast<float>(box.yMin() - bounds.slack);
    out.lower_z = static_cast<float>(box.zMin() - bounds.slack);
    out.upper_x = static_cast<float>(box.xMax() + bounds.slack);
    out.upper_y = static_cast<float>(box.yMax() + bounds.slack);
    out.upper_z = static_cast<float>(box.zMax() + bounds.slack);
}

void occluded(const RTCOccludedFunctionNArguments* arguments)
{
    const Query& query = *static_cast<const Query*>(arguments->context);
    if (arguments->valid[0] && query.visit(static_cast<int>(arguments->primID)))
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

struct ShadowTruth::State
{
    Scene scene;
    osg::Matrixd view, projection, unproject;
    std::vector<EyeTriangle> triangles;
    Bounds bounds;
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;

    State(osg::Node& node, const support::CameraSpec& camera);
    ~State();

    void build();
    EyeLight toEye(const Light& light) const;
    EyeRay rayAt(double x, double y) const;
    bool isCulled(int triangle, const EyeRay& ray) const;
    bool visit(const osg::Vec3d& origin, const osg::Vec3d& direction, double length,
               const std::function<bool(int)>& visit) const;
    double along(int triangle, const EyeRay& ray) const;
    Sample hitAt(int triangle, const EyeRay& ray) const;
    void meet(int triangle, const EyeRay& ray, int& found, double& nearest) const;
    Sample firstHit(const EyeRay& ray) const;
    Sample firstHitOfAll(const EyeRay& ray) const;
    bool castsOnItself(int triangle, const Light& light, const EyeRay& ray) const;
    bool casts(int caster, const Light& light, const EyeLight& eye, const osg::Vec3d& point) const;
    bool isOccluded(const Light& light, const EyeLight& eye, const osg::Vec3d& point,
                    int seen) const;
    bool isOccludedByAny(const Light& light, const EyeLight& eye, const osg::Vec3d& point,
                         int seen) const;
    bool areSame(int a, int b) const;
    template <class Occluded>
    Seen judge(const Light& light, const EyeRay& ray, Sample& sample, Occluded occluded) const;
};

ShadowTruth::State::State(osg::Node& node, const support::CameraSpec& camera)
    : scene(node, camera.view), view(camera.view), projection(camera.projection),
      unproject(osg::Matrixd::inverse(camera.projection))
{
    for (const Triangle& triangle : scene.triangles)
    {
        const osg::Matrixd toEye = scene.frames[triangle.frame].toWorld * view;
        EyeTriangle eye;
        for (int k = 0; k < 3; ++k)
            eye.corner[k] = osg::Vec3d(triangle.local[k]) * toEye;
        eye.normal = (eye.corner[1] - eye.corner[0]) ^ (eye.corner[2] - eye.corner[0]);
        triangles.push_back(eye);
    }
    build();
}

ShadowTruth::State::~State()
{
    rtcReleaseScene(embree);
    rtcReleaseDevice(device);
}

void ShadowTruth::State::build()
{
    double size = 0.0;
    for (const EyeTriangle& triangle : triangles)
        for (const osg::Vec3d& corner : triangle.corner)
            size = std::max(size, largest(corner));
    // Rays and boxes are floats: off by 2^-24 each, of a size that is no larger than the scene's.
    bounds = {&triangles, 1e-6 * size};
    device = rtcNewDevice("threads=1");
    embree = rtcNewScene(device);
    rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(triangles.size()));
    rtcSetGeometryUserData(geometry, &bounds);
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree);
}

/// Calls visit() for all triangles near the ray, which has `length` times its direction, until one
/// returns true.
bool ShadowTruth::State::visit(const osg::Vec3d& origin, const osg::Vec3d& direction, double length,
                               const std::function<bool(int)>& visit) const
{
    Query query;
    rtcInitIntersectContext(&query);
    query.visit = visit;
    RTCRay ray = makeRay(origin, direction, length);
    rtcOccluded1(embree, &query, &ray);
    return ray.tfar < 0.0f;
}

EyeLight ShadowTruth::State::toEye(const Light& light) const
{
    return {light.position * view, osg::Matrixd::transform3x3(light.direction, view),
            light.cosCutoff};
}

EyeRay ShadowTruth::State::rayAt(double x, double y) const
{
    const osg::Vec3d origin = osg::Vec3d(x, y, -1.0) * unproject;
    return {origin, osg::Vec3d(x, y, 1.0) * unproject - origin};
}

bool ShadowTruth::State::isCulled(int triangle, const EyeRay& ray) const
{
    const Culled culled = scene.triangles[triangle].culled;
    if (culled == Culled::NONE || culled == Culled::BOTH)
        return culled == Culled::BOTH;
    const bool front = triangles[triangle].normal * ray.direction < 0.0;
    return front == (culled == Culled::FRONT);
}

/// Where the ray meets the plane of the triangle; NaN or infinity for one that is seen edge on.
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
        !meets(triangles[triangle], ray.origin, ray.direction))
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

bool ShadowTruth::State::castsOnItself(int triangle, const Light& light, const EyeRay& ray) const
{
    const Triangle& t = scene.triangles[triangle];
    const int side = sideOf(t, scene.frames[t.frame], light);
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

/// Whether the triangle lies between the point and the light.
bool ShadowTruth::State::casts(int caster, const Light& light, const EyeLight& eye,
                               const osg::Vec3d& point) const
{
    const Triangle& t = scene.triangles[caster];
    const int lightSide = sideOf(t, scene.frames[t.frame], light);
    const EyeTriangle& e = triangles[caster];
    const double height = (point - e.corner[0]) * e.normal / e.normal.length();
    // A point that lies in the plane by the precision of double is that of a coplanar surface,
    // which casts on itself or not, as that surface does.
    const double rounding = 1e-13 * std::max(largest(point), largest(e.corner[0]));
    if (lightSide == 0 || !(std::abs(height) > rounding) || (height > 0.0) == (lightSide > 0))
        return false;
    return meets(e, point, eye.from(point));
}

bool ShadowTruth::State::isOccluded(const Light& light, const EyeLight& eye,
                                    const osg::Vec3d& point, int seen) const
{
    osg::Vec3d direction = eye.from(point);
    const double distance = direction.normalize();
    const double length =
        eye.position.w() == 0.0 ? std::numeric_limits<double>::infinity() : distance * 1.00001;
    return visit(point, direction, length,
                 [&](int triangle)
                 { return triangle != seen && casts(triangle, light, eye, point); });
}

bool ShadowTruth::State::isOccludedByAny(const Light& light, const EyeLight& eye,
                                         const osg::Vec3d& point, int seen) const
{
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i)
        if (i != seen && casts(i, light, eye, point))
            return true;
    return false;
}

template <class Occluded>
Seen ShadowTruth::State::judge(const Light& light, const EyeRay& ray, Sample& sample,
                               Occluded occluded) const
{
    if (sample.triangle < 0)
        return Seen::NOTHING;
    const EyeLight eye = toEye(light);
    osg::Vec3d toLight = eye.from(sample.point);
    toLight.normalize();
    sample.grazing = std::abs(toLight * sample.normal);
    if (-(toLight * eye.direction) < eye.cosCutoff)
        return Seen::UNREACHED;
    if (castsOnItself(sample.triangle, light, ray))
        return Seen::SHADOWED;
    return occluded(light, eye, sample.point, sample.triangle) ? Seen::SHADOWED : Seen::LIT;
}

ShadowTruth::ShadowTruth(osg::Node& node, const support::CameraSpec& camera)
    : _state(new State(node, camera))
{
}

ShadowTruth::~ShadowTruth() = default;

const Scene& ShadowTruth::getScene() const
{
    return _state->scene;
}

const Light* ShadowTruth::findLight(int number) const
{
    for (const Light& light : _state->scene.lights)
        if (light.number == number)
            return &light;
    return nullptr;
}

Sample ShadowTruth::sample(const Light& light, double x, double y) const
{
    const EyeRay ray = _state->rayAt(x, y);
    Sample sample = _state->firstHit(ray);
    sample.seen =
        _state->judge(light, ray, sample, [this](auto&&... a) { return _state->isOccluded(a...); });
    return sample;
}

Sample ShadowTruth::sampleByAll(const Light& light, double x, double y) const
{
    const EyeRay ray = _state->rayAt(x, y);
    Sample sample = _state->firstHitOfAll(ray);
    sample.seen = _state->judge(light, ray, sample,
                                [this](auto&&... a) { return _state->isOccludedByAny(a...); });
    return sample;
}

std::vector<osg::Vec2d> ShadowTruth::findEdgePoints(const Light& light, double x, double y,
                                                    const osg::Vec2d& pixel) const
{
    const State& s = *_state;
    const Sample first = s.firstHit(s.rayAt(x, y));
    const EyeLight eye = s.toEye(light);
    const osg::Vec2d nowhere(std::numeric_limits<double>::infinity(), 0.0);
    const auto onScreen = [&](const osg::Vec3d& point)
    {
        const osg::Vec4d clip = osg::Vec4d(point, 1.0) * s.projection;
        return clip.w() > 0.0 ? osg::Vec2d(clip.x(), clip.y()) / clip.w() : nowhere;
    };
    const auto inShadow = [&](const osg::Vec3d& point)
    {
        const osg::Vec3d away = -eye.from(point);
        const double along = (first.point - point) * first.normal / (away * first.normal);
        return along >= 0.0 ? onScreen(point + away * along) : nowhere;
    };
    std::vector<osg::Vec2d> points;
    const auto search = [&](const osg::Vec3d& a, const osg::Vec3d& b, const auto& project)
    {
        const auto at = [&](double t) { return project(a + (b - a) * t); };
        const auto distance = [&](double t)
        {
            const osg::Vec2d p = at(t);
            return std::max(std::abs(p.x() - x) / pixel.x(), std::abs(p.y() - y) / pixel.y());
        };
        constexpr int Steps = 16;
        int best = 0;
        for (int i = 1; i <= Steps; ++i)
            if (distance(double(i) / Steps) < distance(double(best) / Steps))
                best = i;
        double low = std::max(best - 1.0, 0.0) / Steps, high = std::min(best + 1.0, 16.0) / Steps;
        for (int i = 0; i < 40; ++i)
        {
            const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
            (distance(left) < distance(right) ? high : low) =
                distance(left) < distance(right) ? right : left;
        }
        if (distance(0.5 * (low + high)) <= 1.0)
            points.push_back(at(0.5 * (low + high)));
    };
    // Most triangles are far away on the screen.
    const auto isNear = [&](const EyeTriangle& triangle, const auto& project)
    {
        constexpr double Infinity = std::numeric_limits<double>::infinity();
        osg::Vec2d low(Infinity, Infinity), high(-Infinity, -Infinity);
        for (const osg::Vec3d& corner : triangle.corner)
        {
            const osg::Vec2d p = project(corner);
            if (p == nowhere)
                return true;
            for (int k = 0; k < 2; ++k)
            {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        return low.x() - pixel.x() <= x && high.x() + pixel.x() >= x && low.y() - pixel.y() <= y &&
               high.y() + pixel.y() >= y;
    };
    const auto searchAll = [&](const EyeTriangle& triangle, const auto& project)
    {
        if (isNear(triangle, project))
            for (int k = 0; k < 3; ++k)
                search(triangle.corner[k], triangle.corner[(k + 1) % 3], project);
    };
    for (const EyeTriangle& triangle : s.triangles)
    {
        searchAll(triangle, onScreen);
        if (first.triangle >= 0)
            searchAll(triangle, inShadow);
    }
    return points;
}

bool ShadowTruth::isWithinDepthQuantum(const Light& light, double x, double y, Seen seen) const
{
    const State& s = *_state;
    const EyeRay ray = s.rayAt(x, y);
    const Sample first = s.firstHit(ray);
    if (first.triangle < 0)
        return false;
    constexpr double Quantum = 2.0 / (1 << 24); // of -1 to 1
    const double depth = (first.point * s.projection).z();
    // Another surface in the same quantum may be the one that the depth buffer kept.
    for (int i = 0; i < static_cast<int>(s.triangles.size()); ++i)
    {
        if (i == first.triangle || s.isCulled(i, ray) ||
            !meets(s.triangles[i], ray.origin, ray.direction))
            continue;
        Sample other = s.hitAt(i, ray);
        if (!(std::abs((other.point * s.projection).z() - depth) <= Quantum) ||
            s.areSame(i, first.triangle))
            continue;
        if (s.judge(light, ray, other, [&](auto&&... a) { return s.isOccluded(a...); }) == seen)
            return true;
    }
    if (s.castsOnItself(first.triangle, light, ray))
        return false;
    const EyeLight eye = s.toEye(light);
    for (double step : {-Quantum, Quantum})
    {
        const osg::Vec3d point = osg::Vec3d(x, y, depth + step) * s.unproject;
        bool occluded = false;
        for (int i = 0; i < static_cast<int>(s.triangles.size()) && !occluded; ++i)
            occluded = !s.areSame(i, first.triangle) && s.casts(i, light, eye, point);
        if (occluded == (seen == Seen::SHADOWED))
            return true;
    }
    return false;
}

namespace
{

/// Depths at which rays around a pixel's center meet something, in normalized device coordinates.
struct DepthRange
{
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    int hits = 0;

    void add(double depth)
    {
        ++hits;
        low = std::min(low, depth);
        high = std::max(high, depth);
    }
};

/// Where the ray meets the side of the volume at the edge (a, b); nothing where it passes the side.
/// The side is taken a thousandth longer at each end, for rays that are off by rounding.
bool meetsSide(const osg::Vec3d& a, const osg::Vec3d& b, const EyeLight& eye, const EyeRay& ray,
               osg::Vec3d& point)
{
    const osg::Vec3d edge = b - a, normal = edge ^ eye.from(a);
    const double slope = ray.direction * normal;
    if (slope == 0.0)
        return false;
    point = ray.origin + ray.direction * (((a - ray.origin) * normal) / slope);
    const osg::Vec3d towards = eye.from(point);
    const double across = (edge ^ towards) * normal;
    if (across == 0.0)
        return false;
    const double share = (((point - a) ^ towards) * normal) / across;
    const osg::Vec3d foot = a + edge * share;
    return share >= -1e-3 && share <= 1.001 && (foot - point) * towards >= -1e-9;
}

} // namespace

bool ShadowTruth::isWithinSnapping(const Light& light, double x, double y,
                                   const osg::Vec2d& pixel) const
{
    const State& s = *_state;
    const EyeLight eye = s.toEye(light);
    constexpr double Quantum = 2.0 / (1 << 24); // of -1 to 1
    std::vector<EyeRay> rays;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            rays.push_back(s.rayAt(x + pixel.x() * i / 256.0, y + pixel.y() * j / 256.0));
    const Sample first = s.firstHit(rays[4]);
    if (first.triangle < 0)
        return false;
    const auto depthOf = [&](const osg::Vec3d& point) { return (point * s.projection).z(); };
    DepthRange surface;
    for (const EyeRay& ray : rays)
        surface.add(depthOf(s.hitAt(first.triangle, ray).point));
    // A face whose edge passes so near to the center may be a hair's breadth wide, and then single
    // precision has no depth for it.
    const auto mayBeAt = [&](const DepthRange& face)
    {
        return (face.hits > 0 && face.hits < static_cast<int>(rays.size())) ||
               (face.low - Quantum <= surface.high && face.high + Quantum >= surface.low);
    };
    for (int i = 0; i < static_cast<int>(s.triangles.size()); ++i)
    {
        const EyeTriangle& triangle = s.triangles[i];
        DepthRange cap, sides[3];
        for (const EyeRay& ray : rays)
        {
            if (!s.areSame(i, first.triangle) && meets(triangle, ray.origin, ray.direction))
                cap.add(depthOf(s.hitAt(i, ray).point));
            osg::Vec3d point;
            for (int k = 0; k < 3; ++k)
                if (meetsSide(triangle.corner[k], triangle.corner[(k + 1) % 3], eye, ray, point))
                    sides[k].add(depthOf(point));
        }
        if (mayBeAt(cap) || mayBeAt(sides[0]) || mayBeAt(sides[1]) || mayBeAt(sides[2]))
            return true;
    }
    return false;
}

std::vector<Sample> ShadowTruth::render(const Light& light, int width, int height) const
{
    std::vector<Sample> samples(static_cast<std::size_t>(width) * height);
    std::atomic<int> next{0};
    const auto work = [&]
    {
        for (int y = next++; y < height; y = next++)
            for (int x = 0; x < width; ++x)
                samples[static_cast<std::size_t>(y) * width + x] =
                    sample(light, 2.0 * (x + 0.5) / width - 1.0, 2.0 * (y + 0.5) / height - 1.0);
    };
    std::vector<std::thread> threads;
    for (unsigned int i = 1; i < std::thread::hardware_concurrency(); ++i)
        threads.emplace_back(work);
    work();
    for (std::thread& thread : threads)
        thread.join();
    return samples;
}

} // namespace truth
