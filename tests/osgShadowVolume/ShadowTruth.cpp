// SPDX-License-Identifier: MIT
#include "ShadowTruth.h"

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

/// Whether the line meets the triangle, or passes it within the rounding of its corners to float.
/// Between two triangles with a common edge no line gets through.
bool meets(const EyeTriangle& t, const osg::Vec3d& origin, const osg::Vec3d& direction)
{
    const osg::Vec3d d = direction / direction.length();
    double low = 0.0, high = 0.0;
    for (int k = 0; k < 3; ++k)
    {
        const osg::Vec3d a = t.corner[k] - origin, b = t.corner[(k + 1) % 3] - origin;
        const double size =
            std::max({largest(t.corner[k]), largest(t.corner[(k + 1) % 3]), largest(origin)});
        // The moment of the edge about the line, less what corners off by 2^-22 change.
        const double moment = d * (a ^ b);
        const double slack = 2.4e-7 * size * (b - a).length();
        low = std::min(low, moment + slack);
        high = std::max(high, moment - slack);
    }
    return !(low < 0.0 && high > 0.0);
}

} // namespace

struct ShadowTruth::State
{
    Scene scene;
    osg::Matrixd view, projection, unproject;
    std::vector<EyeTriangle> triangles;
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;

    State(osg::Node& node, const support::CameraSpec& camera);
    ~State();

    void build();
    EyeLight toEye(const Light& light) const;
    EyeRay rayAt(double x, double y) const;
    bool isCulled(int triangle, const EyeRay& ray) const;
    Sample hitAt(int triangle, const EyeRay& ray, double along) const;
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

namespace
{

/// What Embree's filters are given.
struct Query : RTCIntersectContext
{
    const ShadowTruth* truth;
    std::function<bool(int)> accepts;
};

void filter(const RTCFilterFunctionNArguments* arguments)
{
    const Query& query = *static_cast<const Query*>(arguments->context);
    const unsigned int triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    if (!query.accepts(static_cast<int>(triangle)))
        arguments->valid[0] = 0;
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
    device = rtcNewDevice("threads=1");
    embree = rtcNewScene(device);
    rtcSetSceneFlags(embree, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                        RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    if (!triangles.empty())
    {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        float* vertex = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), 3 * triangles.size()));
        unsigned int* index = static_cast<unsigned int*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned int), triangles.size()));
        for (const EyeTriangle& triangle : triangles)
            for (const osg::Vec3d& corner : triangle.corner)
                for (int k = 0; k < 3; ++k)
                    *vertex++ = static_cast<float>(corner[k]);
        for (unsigned int i = 0; i < 3 * triangles.size(); ++i)
            index[i] = i;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(embree, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree);
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

/// `along` is where Embree found it: for triangles that are seen edge on.
Sample ShadowTruth::State::hitAt(int triangle, const EyeRay& ray, double along) const
{
    const EyeTriangle& t = triangles[triangle];
    Sample sample;
    sample.triangle = triangle;
    sample.normal = t.normal / t.normal.length();
    const double exact = (t.normal * (t.corner[0] - ray.origin)) / (t.normal * ray.direction);
    if (std::abs(exact - along) <= 1e-4 * std::abs(along) + 1e-6)
        along = exact;
    sample.point = ray.origin + ray.direction * along;
    return sample;
}

Sample ShadowTruth::State::firstHit(const EyeRay& ray) const
{
    Query query;
    rtcInitIntersectContext(&query);
    query.accepts = [&](int triangle) { return !isCulled(triangle, ray); };
    query.filter = filter;
    RTCRayHit hit{};
    // A length of 1 is the depth of the view, so that t is of the same size as a depth.
    hit.ray = makeRay(ray.origin, ray.direction, 1.0);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree, &query, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    const double along = hit.ray.tfar;
    Sample first = hitAt(static_cast<int>(hit.hit.primID), ray, along);
    // Which of several within the rounding of floats is the first one, double decides.
    double nearest = (first.point - ray.origin) * ray.direction;
    query.accepts = [&](int triangle)
    {
        if (isCulled(triangle, ray))
            return false;
        const Sample other = hitAt(triangle, ray, along);
        const double distance = (other.point - ray.origin) * ray.direction;
        if (distance < nearest && distance >= 0.0)
        {
            nearest = distance;
            first = other;
        }
        return false;
    };
    RTCRayHit all{};
    all.ray = makeRay(ray.origin, ray.direction, along + 1e-5);
    all.ray.tnear = static_cast<float>(std::max(along - 1e-5, 0.0));
    all.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree, &query, &all);
    return first;
}

Sample ShadowTruth::State::firstHitOfAll(const EyeRay& ray) const
{
    double nearest = std::numeric_limits<double>::infinity();
    int found = -1;
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i)
    {
        const EyeTriangle& t = triangles[i];
        if (isCulled(i, ray) || !meets(t, ray.origin, ray.direction))
            continue;
        const double along = (t.normal * (t.corner[0] - ray.origin)) / (t.normal * ray.direction);
        if (along >= 0.0 && along <= 1.0 && along < nearest)
        {
            nearest = along;
            found = i;
        }
    }
    return found < 0 ? Sample() : hitAt(found, ray, nearest);
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
    Query query;
    rtcInitIntersectContext(&query);
    query.accepts = [&](int triangle)
    { return triangle != seen && casts(triangle, light, eye, point); };
    query.filter = filter;
    osg::Vec3d direction = eye.from(point);
    const double distance = direction.normalize();
    // Embree's float ray starts a little before the point: casts() decides what lies between.
    const double before = 1e-5 * std::max(largest(point), 1e-30);
    const double length = eye.position.w() == 0.0 ? std::numeric_limits<double>::infinity()
                                                  : distance * 1.0001 + 2.0 * before;
    RTCRay ray = makeRay(point - direction * before, direction, length);
    rtcOccluded1(embree, &query, &ray);
    return ray.tfar < 0.0f;
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
        const EyeTriangle& t = s.triangles[i];
        if (i == first.triangle || s.isCulled(i, ray) || !meets(t, ray.origin, ray.direction))
            continue;
        Sample other =
            s.hitAt(i, ray, (t.normal * (t.corner[0] - ray.origin)) / (t.normal * ray.direction));
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
