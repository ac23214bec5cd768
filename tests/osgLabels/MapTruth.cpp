// SPDX-License-Identifier: MIT
#include "MapTruth.h"

#include <embree3/rtcore.h>
#include <osg/BoundingBox>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mapTruth
{

namespace
{

/// From the near to the far plane, which is at 1.
struct EyeRay
{
    osg::Vec3d origin, direction;

    double depthAt(double along) const { return -(origin.z() + along * direction.z()); }
    double alongAt(double depth) const { return (-depth - origin.z()) / direction.z(); }
};

/// What a ray meets.
struct Hit
{
    double along;
    bool isLeaving; ///< A closed mesh.
    const Mesh* mesh;
};

/// Where the ray meets the triangle, its edges too; none for one that is seen edge on.
std::optional<double> meet(const Triangle& triangle, const EyeRay& ray, osg::Vec3d& weights)
{
    const osg::Vec3d a = triangle.corners[0] - ray.origin, b = triangle.corners[1] - ray.origin,
                     c = triangle.corners[2] - ray.origin;
    // Moments of the edges about the line.
    weights.set(ray.direction * (b ^ c), ray.direction * (c ^ a), ray.direction * (a ^ b));
    const bool isInside = (weights.x() >= 0.0 && weights.y() >= 0.0 && weights.z() >= 0.0) ||
                          (weights.x() <= 0.0 && weights.y() <= 0.0 && weights.z() <= 0.0);
    const double sum = weights.x() + weights.y() + weights.z();
    const double slope = triangle.normal * ray.direction;
    if (!isInside || sum == 0.0 || slope == 0.0)
        return std::nullopt;
    weights /= sum;
    return (triangle.normal * a) / slope;
}

struct Query : RTCIntersectContext
{
    void (*visit)(const void* what, unsigned int triangle);
    const void* what;
};

void visitTriangle(const RTCOccludedFunctionNArguments* arguments)
{
    const Query& query = *static_cast<const Query*>(arguments->context);
    if (arguments->valid[0])
        query.visit(query.what, arguments->primID);
}

} // namespace

struct MapTruth::State
{
    Scene scene;
    osg::Matrixd unproject;
    int width, height;
    double slack = 0.0; ///< How far floats may be off, for Embree.
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;

    State(osg::Node& node, const support::CameraSpec& camera, int w, int h,
          const EffectOf& effectOf)
        : scene(node, camera.view, effectOf), unproject(osg::Matrixd::inverse(camera.projection)),
          width(w), height(h)
    {
        for (const Triangle& triangle : scene.triangles)
            for (const osg::Vec3d& corner : triangle.corners)
                slack = std::max(
                    {slack, std::abs(corner.x()), std::abs(corner.y()), std::abs(corner.z())});
        slack *= 1e-6;
        device = rtcNewDevice("threads=1");
        embree = rtcNewScene(device);
        rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry,
                                         static_cast<unsigned int>(scene.triangles.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
        rtcSetGeometryOccludedFunction(geometry, visitTriangle);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(embree, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(embree);
    }
    ~State()
    {
        rtcReleaseScene(embree);
        rtcReleaseDevice(device);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    static void boundsOf(const RTCBoundsFunctionArguments* arguments)
    {
        const State& state = *static_cast<const State*>(arguments->geometryUserPtr);
        osg::BoundingBoxd box;
        for (const osg::Vec3d& corner : state.scene.triangles[arguments->primID].corners)
            box.expandBy(corner);
        RTCBounds& out = *arguments->bounds_o;
        out.lower_x = static_cast<float>(box.xMin() - state.slack);
        out.lower_y = static_cast<float>(box.yMin() - state.slack);
        out.lower_z = static_cast<float>(box.zMin() - state.slack);
        out.upper_x = static_cast<float>(box.xMax() + state.slack);
        out.upper_y = static_cast<float>(box.yMax() + state.slack);
        out.upper_z = static_cast<float>(box.zMax() + state.slack);
    }

    EyeRay rayAt(double x, double y) const
    {
        const double u = 2.0 * x / width - 1.0, v = 2.0 * y / height - 1.0;
        const osg::Vec3d origin = osg::Vec3d(u, v, -1.0) * unproject;
        return {origin, osg::Vec3d(u, v, 1.0) * unproject - origin};
    }

    void add(unsigned int index, const EyeRay& ray, std::vector<Hit>& hits) const
    {
        const Triangle& triangle = scene.triangles[index];
        const Mesh& mesh = scene.meshes[triangle.mesh];
        osg::Vec3d weights;
        const std::optional<double> along = meet(triangle, ray, weights);
        if (!along || !(*along >= 0.0))
            return;
        if (mesh.alpha)
        {
            osg::Vec2f place;
            for (int k = 0; k < 3; ++k)
                place += triangle.texCoords[k] * float(weights[k]);
            if (!(alphaAt(*mesh.alpha, place) > mesh.leastAlpha))
                return;
        }
        const bool isLeaving =
            mesh.outward != 0 && mesh.outward * (triangle.normal * ray.direction) > 0.0;
        hits.push_back({*along, isLeaving, &mesh});
    }

    /// All that the ray meets from the near plane to `end`, in any order.
    std::vector<Hit> hitsOn(const EyeRay& ray, double end) const
    {
        std::vector<Hit> hits;
        const auto visit = [&](unsigned int triangle) { add(triangle, ray, hits); };
        Query query;
        rtcInitIntersectContext(&query);
        query.visit = [](const void* what, unsigned int triangle)
        { (*static_cast<const decltype(visit)*>(what))(triangle); };
        query.what = &visit;
        RTCRay out{};
        out.org_x = static_cast<float>(ray.origin.x());
        out.org_y = static_cast<float>(ray.origin.y());
        out.org_z = static_cast<float>(ray.origin.z());
        out.dir_x = static_cast<float>(ray.direction.x());
        out.dir_y = static_cast<float>(ray.direction.y());
        out.dir_z = static_cast<float>(ray.direction.z());
        // Boxes are larger by the slack, the way to them need not be.
        out.tfar = static_cast<float>(end * 1.00001 + 1e-6);
        out.mask = ~0u;
        rtcOccluded1(embree, &query, &out);
        return hits;
    }

    std::vector<Hit> allHitsOn(const EyeRay& ray) const
    {
        std::vector<Hit> hits;
        for (unsigned int i = 0; i < scene.triangles.size(); ++i)
            add(i, ray, hits);
        return hits;
    }

    static bool isOwn(const Hit& hit, const Label& label)
    {
        return !label.feature.empty() && hit.mesh->names.count(label.feature);
    }

    static bool isFace(const Hit& hit) { return hit.isLeaving || !hit.mesh->outward; }

    /// What the hits do to a label that lies at `end`.
    static Effect judge(const std::vector<Hit>& hits, const Label& label, double end)
    {
        std::optional<double> back;
        if (label.isAtBack)
            for (const Hit& hit : hits)
                if (isOwn(hit, label) && isFace(hit))
                    back = back ? std::min(*back, hit.along) : hit.along;
        end = back.value_or(end);
        Effect effect = Effect::None;
        for (const Hit& hit : hits)
            if (hit.along < end && !isOwn(hit, label) && isFace(hit))
                effect = std::max(effect, hit.mesh->effect);
        return effect;
    }
};

MapTruth::MapTruth(osg::Node& node, const support::CameraSpec& camera, int width, int height,
                   const EffectOf& effectOf)
    : _state(new State(node, camera, width, height, effectOf))
{
}

MapTruth::~MapTruth() = default;

Effect MapTruth::at(const Label& label, double x, double y) const
{
    const EyeRay ray = _state->rayAt(x, y);
    const double end = ray.alongAt(label.depth);
    // Back faces may lie anywhere, up to the far plane.
    return State::judge(_state->hitsOn(ray, label.isAtBack ? 1.0 : end), label, end);
}

Effect MapTruth::atByAll(const Label& label, double x, double y) const
{
    const EyeRay ray = _state->rayAt(x, y);
    return State::judge(_state->allHitsOn(ray), label, ray.alongAt(label.depth));
}

bool MapTruth::isCertain(const Label& label, double x, double y) const
{
    const Effect effect = at(label, x, y);
    for (const double share : {1.0 - 4e-6, 1.0 + 4e-6})
        if (at({label.depth * share, label.feature, label.isAtBack}, x, y) != effect)
            return false;
    // Coarse places first: most edges are long.
    for (const int parts : {2, 16})
        for (int j = -parts; j <= parts; ++j)
            for (int i = -parts; i <= parts; ++i)
                if (at(label, x + double(i) / parts, y + double(j) / parts) != effect)
                    return false;
    return true;
}

} // namespace mapTruth
