// SPDX-License-Identifier: MIT
#include "TruthState.h"

#include <algorithm>
#include <cmath>
#include <limits>

// What excuses a wrong pixel: each is a proof about that pixel.
namespace truth
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Looks for the points of edges, as a projection shows them, that come nearest to a point.
class EdgeSearch
{
public:
    std::vector<osg::Vec2d> points;

    EdgeSearch(const osg::Vec2d& center, const osg::Vec2d& pixel) : _center(center), _pixel(pixel)
    {
    }

    static osg::Vec2d nowhere() { return {Infinity, 0.0}; }

    template <class Project> void search(const EyeTriangle& triangle, const Project& project)
    {
        for (int k = 0; k < 3; ++k)
            searchEdge(triangle.corner[k], triangle.corner[(k + 1) % 3], project);
    }

private:
    /// In pixels, the larger one of both directions.
    double distanceTo(const osg::Vec2d& p) const
    {
        return std::max(std::abs(p.x() - _center.x()) / _pixel.x(),
                        std::abs(p.y() - _center.y()) / _pixel.y());
    }

    template <class Project>
    void searchEdge(const osg::Vec3d& a, const osg::Vec3d& b, const Project& project)
    {
        const auto at = [&](double t) { return project(a + (b - a) * t); };
        const auto distance = [&](double t) { return distanceTo(at(t)); };
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
    }

    osg::Vec2d _center, _pixel;
};

/// Depths at which rays around a pixel's center meet something, in normalized device coordinates.
struct DepthRange
{
    double low = Infinity;
    double high = -Infinity;
    int hits = 0;

    void add(double depth)
    {
        ++hits;
        low = std::min(low, depth);
        high = std::max(high, depth);
    }

    /// Whether a face with these depths, of that many rays, may lie on either side of the surface.
    /// One whose edge passes so near to the center may be a hair's breadth wide, and then single
    /// precision has no depth for it.
    bool mayBeAt(const DepthRange& surface, int rays) const
    {
        return (hits > 0 && hits < rays) ||
               (low - DepthQuantum <= surface.high && high + DepthQuantum >= surface.low);
    }
};

/// Where the ray meets the side of the volume at the edge (a, b); nothing where it passes the side.
/// The side is taken a thousandth longer at each end, for rays that are off by rounding.
bool meetsSide(const osg::Vec3d& a, const osg::Vec3d& b, const EyeLight& light, const EyeRay& ray,
               osg::Vec3d& point)
{
    const osg::Vec3d edge = b - a, normal = edge ^ light.from(a);
    const double slope = ray.direction * normal;
    if (slope == 0.0)
        return false;
    point = ray.origin + ray.direction * (((a - ray.origin) * normal) / slope);
    const osg::Vec3d towards = light.from(point);
    const double across = (edge ^ towards) * normal;
    if (across == 0.0)
        return false;
    const double share = (((point - a) ^ towards) * normal) / across;
    const osg::Vec3d foot = a + edge * share;
    // The edge lies between the point and a light that is somewhere.
    const double way = (foot - point) * towards;
    const bool isBehind =
        way >= -1e-9 && (light.position.w() == 0.0 || way <= towards.length2() * (1.0 + 1e-9));
    return share >= -1e-3 && share <= 1.001 && isBehind;
}

/// Where the shadow of a triangle may touch what a pixel shows of a plane: near the line from the
/// middle of that to the light, since what lies between a point beside the middle and the light is
/// no farther from the line than the point.
class ShadowReach
{
public:
    /// `corners` are rays at the corners of the pixel.
    ShadowReach(const osg::Vec3d& point, const osg::Vec3d& normal, const osg::Vec3d& toLight,
                const std::vector<EyeRay>& corners)
        : _point(point), _toLight(toLight / toLight.length())
    {
        for (const EyeRay& ray : corners)
        {
            const double along = ((point - ray.origin) * normal) / (ray.direction * normal);
            const double distance = (ray.origin + ray.direction * along - point).length();
            // A ray that misses the plane says that the pixel shows it to infinity.
            _size = along > 0.0 && distance < Infinity ? std::max(_size, distance) : Infinity;
        }
    }

    bool mayTouch(const EyeTriangle& triangle) const
    {
        const double distance = ((triangle.middle - _point) ^ _toLight).length();
        return !(distance > (triangle.radius + _size) * (1.0 + 1e-9));
    }

private:
    osg::Vec3d _point, _toLight;
    double _size = 0.0;
};

/// A ray, to be asked about the sides of many volumes.
struct SnappedRay
{
    EyeRay ray;
    osg::Vec3d away; ///< Its moments about lines from the light: (v - origin) * away.

    SnappedRay(const EyeRay& r, const EyeLight& light) : ray(r), away(light.from(r.origin) ^ r.unit)
    {
    }

    /// Where it meets the side at edge k.
    bool meetsSide(const EyeTriangle& t, int k, const EyeLight& light, osg::Vec3d& point) const
    {
        const osg::Vec3d &a = t.corner[k], &b = t.corner[(k + 1) % 3];
        // Along the edge the moments are linear, and vanish where the ray meets the side.
        const double momentA = (a - ray.origin) * away, momentB = (b - ray.origin) * away;
        const bool isBeside =
            (momentA > 0.0) == (momentB > 0.0) &&
            std::min(std::abs(momentA), std::abs(momentB)) > 2e-3 * std::abs(momentA - momentB);
        return !isBeside && truth::meetsSide(a, b, light, ray, point);
    }
};

} // namespace

std::vector<osg::Vec2d> ShadowTruth::findEdgePoints(const Light& light, double x, double y,
                                                    const osg::Vec2d& pixel) const
{
    const State& s = *_state;
    const Sample first = s.firstHit(s.rayAt(x, y));
    const EyeLight eye = s.toEye(light);
    const auto onScreen = [&](const osg::Vec3d& point)
    {
        const osg::Vec4d clip = osg::Vec4d(point, 1.0) * s.projection;
        return clip.w() > 0.0 ? osg::Vec2d(clip.x(), clip.y()) / clip.w() : EdgeSearch::nowhere();
    };
    const auto inShadow = [&](const osg::Vec3d& point)
    {
        const osg::Vec3d away = -eye.from(point);
        const double along = (first.point - point) * first.normal / (away * first.normal);
        return along >= 0.0 ? onScreen(point + away * along) : EdgeSearch::nowhere();
    };
    EdgeSearch edges({x, y}, pixel);
    for (const EyeTriangle& triangle : s.triangles)
        if (triangle.isOnScreen({x, y}, pixel))
            edges.search(triangle, onScreen);
    if (first.triangle < 0)
        return edges.points;
    std::vector<EyeRay> corners;
    for (int i = 0; i < 4; ++i)
        corners.push_back(
            s.rayAt(x + (i & 1 ? pixel.x() : -pixel.x()), y + (i & 2 ? pixel.y() : -pixel.y())));
    const ShadowReach reach(first.point, first.normal, eye.from(first.point), corners);
    for (const EyeTriangle& triangle : s.triangles)
        if (reach.mayTouch(triangle))
            edges.search(triangle, inShadow);
    return edges.points;
}

bool ShadowTruth::isObjectEdgeBetween(const osg::Vec2d& from, const osg::Vec2d& to) const
{
    const State& s = *_state;
    const auto rayAt = [&](double share)
    {
        const osg::Vec2d p = from + (to - from) * share;
        return s.rayAt(p.x(), p.y());
    };
    const auto seenAt = [&](double share) { return s.firstHit(rayAt(share)).triangle; };
    const int last = seenAt(1.0);
    double start = 0.0;
    int first = seenAt(start);
    // From one triangle to the next, as long as they join.
    for (int joins = 0; joins < 16 && first != last; ++joins)
    {
        double high = 1.0;
        int second = last;
        for (int i = 0; i < 40; ++i)
        {
            const double middle = 0.5 * (start + high);
            const int found = seenAt(middle);
            (found == first ? start : high) = middle;
            second = found == first ? second : found;
        }
        if (first < 0 || second < 0)
            return true;
        const EyeRay ray = rayAt(high);
        const double gap =
            s.depthOf(s.hitAt(first, ray).point) - s.depthOf(s.hitAt(second, ray).point);
        if (std::abs(gap) > DepthQuantum)
            return true;
        start = high;
        first = second;
    }
    return false;
}

bool ShadowTruth::isWithinDepthQuantum(const Light& light, double x, double y, Seen seen) const
{
    const State& s = *_state;
    const EyeLight eye = s.toEye(light);
    const EyeRay ray = s.rayAt(x, y);
    const Sample first = s.firstHit(ray);
    if (first.triangle < 0)
        return false;
    const double depth = s.depthOf(first.point);
    const osg::Vec2d rounding(1e-6, 1e-6); // many times that of double
    const int count = static_cast<int>(s.triangles.size());
    // Another surface in the same quantum may be the one that the depth buffer kept.
    for (int i = 0; i < count; ++i)
    {
        if (i == first.triangle || !s.triangles[i].isOnScreen({x, y}, rounding) ||
            s.isCulled(i, ray) || !meets(s.triangles[i], ray.origin, ray.unit))
            continue;
        Sample other = s.hitAt(i, ray);
        if (!(std::abs(s.depthOf(other.point) - depth) <= DepthQuantum) ||
            s.areSame(i, first.triangle))
            continue;
        if (s.judge(eye, ray, other) == seen)
            return true;
    }
    if (s.castsOnItself(first.triangle, eye, ray))
        return false;
    for (double step : {-DepthQuantum, DepthQuantum})
    {
        const osg::Vec3d point = osg::Vec3d(x, y, depth + step) * s.unproject;
        const bool occluded = s.isOccludedByOthers(eye, point, first.triangle);
        if (occluded == (seen == Seen::SHADOWED))
            return true;
    }
    return false;
}

bool ShadowTruth::isWithinSnapping(const Light& light, double x, double y,
                                   const osg::Vec2d& pixel) const
{
    const State& s = *_state;
    const EyeLight eye = s.toEye(light);
    std::vector<SnappedRay> rays;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            rays.emplace_back(s.rayAt(x + pixel.x() * i / 256.0, y + pixel.y() * j / 256.0), eye);
    const int count = static_cast<int>(rays.size());
    const Sample first = s.firstHit(rays[4].ray);
    if (first.triangle < 0)
        return false;
    DepthRange surface;
    for (const SnappedRay& snapped : rays)
        surface.add(s.depthOf(s.hitAt(first.triangle, snapped.ray).point));
    for (int i = 0; i < static_cast<int>(s.triangles.size()); ++i)
    {
        const EyeTriangle& triangle = s.triangles[i];
        const bool isOther = triangle.isOnScreen({x, y}, pixel) && !s.areSame(i, first.triangle);
        DepthRange cap, sides[3];
        for (const SnappedRay& snapped : rays)
        {
            if (isOther && meets(triangle, snapped.ray.origin, snapped.ray.unit))
                cap.add(s.depthOf(s.hitAt(i, snapped.ray).point));
            osg::Vec3d point;
            for (int k = 0; k < 3; ++k)
                if (snapped.meetsSide(triangle, k, eye, point))
                    sides[k].add(s.depthOf(point));
        }
        if (cap.mayBeAt(surface, count) ||
            std::any_of(sides, sides + 3,
                        [&](const DepthRange& side) { return side.mayBeAt(surface, count); }))
            return true;
    }
    return false;
}

} // namespace truth
