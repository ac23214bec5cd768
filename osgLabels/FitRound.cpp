// SPDX-License-Identifier: MIT
#include <osgLabels/FitMesh.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// How far a vertex may be off, as a share of the radius.
constexpr double Tolerance = 2e-3;
/// Cosine of the widest step from vertex to vertex around an axis: a fifth of a circle.
constexpr double WidestStep = 0.28;
/// The same over a sphere, where octahedra count.
constexpr double WidestSphereStep = -0.05;
/// Of the exact shape's area, what a mesh has to cover; a flat cone of five segments has 0.757.
constexpr double LeastCover = 0.74;
constexpr double LeastSphereCover = 0.5;

/// The mesh around an axis through its surface's centroid: what turns around an axis has its
/// centroid there.
class Profile
{
public:
    Profile(const FitMesh& fitMesh, const glm::dvec3& axis)
        : mesh(fitMesh), frame(frameAround(axis)), center(fitMesh.centroid)
    {
    }

    /// Whether as much of the surface faces one way as any other around the axis.
    bool isEven() const
    {
        const glm::dmat3 turned = glm::transpose(frame) * mesh.spread * frame;
        const double sum = turned[0][0] + turned[1][1];
        return std::hypot(turned[0][0] - turned[1][1], 2.0 * turned[0][1]) <= 0.05 * sum;
    }

    /// Reads the points.
    void prepare()
    {
        around.reserve(mesh.points.size());
        at.reserve(mesh.points.size());
        for (const glm::dvec3& point : mesh.points)
        {
            const glm::dvec3 p = (point - center) * frame;
            around.emplace_back(p.x, p.y);
            at.emplace_back(std::sqrt(p.x * p.x + p.y * p.y), p.z);
            low = std::min(low, p.z);
            high = std::max(high, p.z);
        }
    }

    double widestAt(double z, double tolerance) const
    {
        double widest = 0.0;
        for (const glm::dvec2& p : at)
            if (std::abs(p.y - z) <= tolerance)
                widest = std::max(widest, p.x);
        return widest;
    }

    FittedShape make(Shape shape, double z, const glm::dvec3& size, bool upsideDown = false) const
    {
        glm::dmat3 turned = frame;
        if (upsideDown)
            turned = {frame[0], -frame[1], -frame[2]};
        return makeShape(mesh, shape, turned, center + z * frame[2], size);
    }

    const FitMesh& mesh;
    glm::dmat3 frame;
    glm::dvec3 center;
    std::vector<glm::dvec2> around; ///< Of each point: its place across the axis.
    std::vector<glm::dvec2> at;     ///< Its distance from the axis, and its place along it.
    double low = 1e300, high = -1e300;
};

/// Whether the facet's corners are close enough together around the axis.
bool stepsAround(const Profile& profile, const FitMesh::Facet& facet, double tolerance)
{
    for (int k = 0; k != 3; ++k)
    {
        const std::uint32_t a = facet.corners[k], b = facet.corners[(k + 1) % 3];
        const double from = profile.at[a].x, to = profile.at[b].x;
        if (from > tolerance && to > tolerance &&
            glm::dot(profile.around[a], profile.around[b]) < WidestStep * from * to)
            return false;
    }
    return true;
}

std::optional<FittedShape> fitFrustum(const Profile& profile)
{
    const double height = profile.high - profile.low;
    const double endTolerance = 4.0 * profile.mesh.noise + Tolerance * height;
    const double r0 = profile.widestAt(profile.low, endTolerance);
    const double r1 = profile.widestAt(profile.high, endTolerance);
    const double wide = std::max(r0, r1);
    const double tolerance = 4.0 * profile.mesh.noise + Tolerance * wide;
    if (height <= 10.0 * profile.mesh.noise || wide <= 20.0 * profile.mesh.noise)
        return std::nullopt;
    const double slope = (r1 - r0) / height;
    const auto isOnSide = [&](const glm::dvec2& p)
    { return std::abs(p.x - (r0 + slope * (p.y - profile.low))) <= tolerance; };
    for (const glm::dvec2& p : profile.at)
        if (!isOnSide(p) && p.y - profile.low > endTolerance && profile.high - p.y > endTolerance)
            return std::nullopt;
    double side = 0.0;
    for (const FitMesh::Facet& facet : profile.mesh.facets)
    {
        bool onSide = true, flat = true;
        for (const std::uint32_t corner : facet.corners)
        {
            const glm::dvec2& p = profile.at[corner];
            onSide = onSide && isOnSide(p);
            flat = flat && std::abs(p.y - profile.at[facet.corners[0]].y) <= endTolerance;
        }
        if (!onSide || flat)
            continue;
        if (!stepsAround(profile, facet, tolerance))
            return std::nullopt;
        side += facet.area;
    }
    if (side < LeastCover * glm::pi<double>() * (r0 + r1) * std::hypot(height, r1 - r0))
        return std::nullopt;
    const double middle = 0.5 * (profile.low + profile.high);
    if (std::abs(r1 - r0) <= tolerance)
    {
        const double r = 0.5 * (r0 + r1);
        return profile.make(Shape::Cylinder, middle, {r, r, 0.5 * height});
    }
    // What is nearly nothing is a point.
    const double first = r0 <= tolerance ? 0.0 : r0, second = r1 <= tolerance ? 0.0 : r1;
    return profile.make(Shape::Frustum, middle, {first, second, 0.5 * height});
}

std::optional<FittedShape> fitDish(const Profile& profile)
{
    const double height = profile.high - profile.low;
    const double endTolerance = 4.0 * profile.mesh.noise + Tolerance * height;
    const double r0 = profile.widestAt(profile.low, endTolerance);
    const double r1 = profile.widestAt(profile.high, endTolerance);
    const double radius = std::max(r0, r1);
    const double tolerance = 4.0 * profile.mesh.noise + Tolerance * std::min(radius, height);
    if (std::min(r0, r1) > tolerance + Tolerance * radius || height <= 20.0 * profile.mesh.noise ||
        radius <= 20.0 * profile.mesh.noise)
        return std::nullopt;
    const bool upsideDown = r1 > r0;
    const double base = upsideDown ? profile.high : profile.low;
    for (const glm::dvec2& p : profile.at)
    {
        const double up = std::abs(p.y - base);
        const double off = std::abs(std::hypot(p.x / radius, up / height) - 1.0);
        if (off * std::min(radius, height) > tolerance && up > endTolerance)
            return std::nullopt;
    }
    return profile.make(Shape::Dish, base, {radius, radius, height}, upsideDown);
}

/// Solves a small symmetric system by elimination; false where it has no solution.
template <int N> bool solve(double (&m)[N][N + 1], double (&x)[N])
{
    for (int i = 0; i != N; ++i)
    {
        int pivot = i;
        for (int k = i + 1; k != N; ++k)
            if (std::abs(m[k][i]) > std::abs(m[pivot][i]))
                pivot = k;
        if (!(std::abs(m[pivot][i]) > 1e-14))
            return false;
        std::swap(m[i], m[pivot]);
        for (int k = i + 1; k != N; ++k)
            for (int j = N; j >= i; --j)
                m[k][j] -= m[k][i] / m[i][i] * m[i][j];
    }
    for (int i = N - 1; i >= 0; --i)
    {
        x[i] = m[i][N];
        for (int k = i + 1; k != N; ++k)
            x[i] -= m[i][k] * x[k];
        x[i] /= m[i][i];
    }
    return true;
}

std::optional<FittedShape> fitTorus(const Profile& profile)
{
    // The circle of the profile: r² + z² = 2 R r + 2 z0 z + c, by least squares.
    double m[3][4] = {};
    for (const glm::dvec2& p : profile.at)
    {
        const double row[4] = {2.0 * p.x, 2.0 * p.y, 1.0, glm::dot(p, p)};
        for (int i = 0; i != 3; ++i)
            for (int k = 0; k != 4; ++k)
                m[i][k] += row[i] * row[k] / double(profile.mesh.points.size());
    }
    double x[3];
    if (!solve(m, x))
        return std::nullopt;
    const glm::dvec2 middle(x[0], x[1]);
    const double squared = x[2] + glm::dot(middle, middle);
    const double tube = squared > 0.0 ? std::sqrt(squared) : 0.0;
    if (tube <= 20.0 * profile.mesh.noise || middle.x < 0.3 * tube)
        return std::nullopt;
    const double tolerance = 4.0 * profile.mesh.noise + Tolerance * tube;
    for (const glm::dvec2& p : profile.at)
        if (std::abs(glm::distance(p, middle) - tube) > tolerance)
            return std::nullopt;
    for (const FitMesh::Facet& facet : profile.mesh.facets)
    {
        if (!stepsAround(profile, facet, tolerance))
            return std::nullopt;
        for (int k = 0; k != 3; ++k)
        {
            const glm::dvec2 a = profile.at[facet.corners[k]] - middle;
            const glm::dvec2 b = profile.at[facet.corners[(k + 1) % 3]] - middle;
            if (glm::dot(a, b) < 0.2 * tube * tube)
                return std::nullopt;
        }
    }
    return profile.make(Shape::Torus, middle.y, {middle.x, tube, glm::two_pi<double>()});
}

std::optional<FittedShape> fitSphere(const FitMesh& mesh)
{
    // p² = 2 c p + k, by least squares.
    double m[4][5] = {};
    for (const glm::dvec3& p : mesh.points)
    {
        const double row[5] = {2.0 * p.x, 2.0 * p.y, 2.0 * p.z, 1.0, glm::dot(p, p)};
        for (int i = 0; i != 4; ++i)
            for (int k = 0; k != 5; ++k)
                m[i][k] += row[i] * row[k] / double(mesh.points.size());
    }
    double x[4];
    if (!solve(m, x))
        return std::nullopt;
    const glm::dvec3 center(x[0], x[1], x[2]);
    const double squared = x[3] + glm::dot(center, center);
    const double radius = squared > 0.0 ? std::sqrt(squared) : 0.0;
    const double tolerance = 4.0 * mesh.noise + Tolerance * radius;
    if (radius <= 20.0 * mesh.noise || radius > 1.0)
        return std::nullopt;
    for (const glm::dvec3& point : mesh.points)
        if (std::abs(glm::distance(point, center) - radius) > tolerance)
            return std::nullopt;
    // Three triangles and more in a plane are a side of a dodecahedron or the like: each direction
    // has two sides of two.
    if (!mesh.curved && mesh.facets.size() > 4 * mesh.directions.size())
        return std::nullopt;
    glm::dvec3 balance(0.0);
    for (const FitMesh::Facet& facet : mesh.facets)
    {
        balance += facet.area / mesh.area * (facet.middle - center);
        for (int k = 0; k != 3; ++k)
            if (glm::dot(mesh.points[facet.corners[k]] - center,
                         mesh.points[facet.corners[(k + 1) % 3]] - center) <
                WidestSphereStep * radius * radius)
                return std::nullopt;
    }
    // Parts of spheres are out of balance.
    if (glm::length(balance) > 0.05 * radius || mesh.facets.size() < 8 ||
        mesh.area < LeastSphereCover * 4.0 * glm::pi<double>() * radius * radius)
        return std::nullopt;
    return makeShape(mesh, Shape::Sphere, glm::dmat3(1.0), center, glm::dvec3(radius));
}

/// Axes that the mesh may turn around: flat ends, then principal axes of the normals.
std::vector<Profile> profilesOf(const FitMesh& mesh)
{
    std::vector<glm::dvec3> axes;
    const auto add = [&](const glm::dvec3& axis)
    {
        for (const glm::dvec3& other : axes)
            if (std::abs(glm::dot(axis, other)) > 1.0 - 1e-13)
                return;
        // Towards the side of the coordinates' positive axes.
        const int most = std::abs(axis.z) >= std::max(std::abs(axis.x), std::abs(axis.y)) - 1e-9 ? 2
                         : std::abs(axis.y) >= std::abs(axis.x) - 1e-9                           ? 1
                                                                       : 0;
        axes.push_back(axis[most] < 0.0 ? -axis : axis);
    };
    // Principal axes come from all facets and are more exact, where they are defined at all.
    for (int i = 0; i != 3; ++i)
        add(mesh.axes[i]);
    for (std::size_t i = 0; i != std::min<std::size_t>(2, mesh.directions.size()); ++i)
        if (mesh.directions[i].area > 0.05 * mesh.area)
            add(mesh.directions[i].normal);
    std::vector<Profile> profiles;
    for (const glm::dvec3& axis : axes)
        if (Profile profile(mesh, axis); profile.isEven())
        {
            profile.prepare();
            profiles.push_back(std::move(profile));
        }
    return profiles;
}

} // namespace

std::optional<FittedShape> fitRound(const FitMesh& mesh)
{
    if (mesh.facets.size() < 5)
        return std::nullopt;
    const std::vector<Profile> profiles = profilesOf(mesh);
    for (const Profile& profile : profiles)
        if (auto frustum = fitFrustum(profile))
            return frustum;
    if (auto sphere = fitSphere(mesh))
        return sphere;
    for (const Profile& profile : profiles)
    {
        if (auto dish = fitDish(profile))
            return dish;
        if (auto torus = fitTorus(profile))
            return torus;
    }
    return std::nullopt;
}

} // namespace osgLabels
