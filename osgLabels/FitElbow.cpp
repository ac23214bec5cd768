// SPDX-License-Identifier: MIT
#include <osgLabels/FitMesh.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osgLabels
{

namespace
{

constexpr double Tolerance = 3e-3;       ///< Of the tube's radius.
constexpr double LeastCover = 0.7;       ///< Of the exact tube's area.
constexpr std::size_t MostSamples = 400; ///< Points and, twice as many, facets for a first guess.

struct Ring
{
    glm::dvec3 axis, center;
    double radius, tube;
};

/// A point by a ring: along the axis, from it, and from the tube's middle.
struct ByRing
{
    ByRing(const Ring& ring, const glm::dvec3& point) : from(point - ring.center)
    {
        z = glm::dot(from, ring.axis);
        const glm::dvec3 flat = from - z * ring.axis;
        rho = std::max(glm::length(flat), 1e-300);
        outward = flat / rho;
        across = std::hypot(rho - ring.radius, z);
    }

    glm::dvec3 from, outward;
    double z, rho, across;
};

/// Solves a symmetric system of three by its inverse.
std::optional<glm::dvec3> solve(const glm::dmat3& m, const glm::dvec3& right)
{
    const double size = std::abs(m[0][0]) + std::abs(m[1][1]) + std::abs(m[2][2]);
    if (!(std::abs(glm::determinant(m)) > 1e-13 * size * size * size))
        return std::nullopt;
    return glm::inverse(m) * right;
}

/// From facet to facet for a guess; odd, so that it meets both triangles of quads.
std::size_t strideOf(const FitMesh& mesh)
{
    return (mesh.facets.size() / (2 * MostSamples)) | 1u;
}

/// A ring with an axis of that direction. The normals of what turns around an axis meet the axis,
/// which gives its place; then the profile's circle is one of least squares. Facets that face along
/// `along` too much may be flat ends, which do not turn, and are left out.
std::optional<Ring> guessRing(const FitMesh& mesh, const std::vector<glm::dvec3>& points,
                              const glm::dvec3& axis, const glm::dvec3& along)
{
    const glm::dmat3 frame = frameAround(axis);
    // The third row keeps the system regular: nothing is said of the place along the axis.
    glm::dmat3 m(0.0);
    m[2][2] = 1.0;
    glm::dvec3 right(0.0);
    const std::size_t stride = strideOf(mesh);
    for (std::size_t i = 0; i < mesh.facets.size(); i += stride)
    {
        const FitMesh::Facet& facet = mesh.facets[i];
        if (std::abs(glm::dot(facet.normal, along)) > 0.6)
            continue;
        const glm::dvec3 n = facet.normal * frame, p = facet.middle * frame;
        const glm::dvec3 row(n.y, -n.x, 0.0);
        const double weight = facet.area / mesh.area;
        m += weight * glm::outerProduct(row, row);
        right += weight * glm::dot(row, p) * row;
    }
    const auto place = solve(m, right);
    if (!place || glm::dot(*place, *place) > 1e6)
        return std::nullopt;
    const glm::dvec3 center = frame * *place;
    m = glm::dmat3(0.0);
    right = glm::dvec3(0.0);
    for (const glm::dvec3& point : points)
    {
        const glm::dvec3 p = (point - center) * frame;
        const glm::dvec2 at(std::hypot(p.x, p.y), p.z);
        const glm::dvec3 row(2.0 * at.x, 2.0 * at.y, 1.0);
        m += glm::outerProduct(row, row);
        right += glm::dot(at, at) * row;
    }
    const auto circle = solve(m, right);
    if (!circle)
        return std::nullopt;
    const double squared = circle->z + circle->x * circle->x + circle->y * circle->y;
    if (!(squared > 0.0))
        return std::nullopt;
    return Ring{axis, center + circle->y * axis, circle->x, std::sqrt(squared)};
}

/// The rows of a least squares step: tilt of the axis, center, radius, tube.
using Step = std::array<double, 7>;

bool solve(std::array<std::array<double, 8>, 7>& m, Step& x)
{
    for (int i = 0; i != 7; ++i)
    {
        int pivot = i;
        for (int k = i + 1; k != 7; ++k)
            if (std::abs(m[k][i]) > std::abs(m[pivot][i]))
                pivot = k;
        if (!(std::abs(m[pivot][i]) > 1e-13))
            return false;
        std::swap(m[i], m[pivot]);
        for (int k = i + 1; k != 7; ++k)
            for (int j = 7; j >= i; --j)
                m[k][j] -= m[k][i] / m[i][i] * m[i][j];
    }
    for (int i = 6; i >= 0; --i)
    {
        x[i] = m[i][7];
        for (int k = i + 1; k != 7; ++k)
            x[i] -= m[i][k] * x[k];
        x[i] /= m[i][i];
    }
    return true;
}

/// One step of Gauss and Newton; false where there is none. Points well inside the tube belong to
/// its flat ends and do not count.
bool improve(Ring& ring, const std::vector<glm::dvec3>& points)
{
    const glm::dmat3 frame = frameAround(ring.axis);
    std::array<std::array<double, 8>, 7> m{};
    for (const glm::dvec3& point : points)
    {
        const ByRing at(ring, point);
        if (at.across < 0.7 * ring.tube)
            continue;
        const double out = (at.rho - ring.radius) / at.across, up = at.z / at.across;
        const double tilt = up * ring.radius / at.rho;
        const glm::dvec3 away = out * at.outward + up * ring.axis;
        const double row[8] = {tilt * glm::dot(at.from, frame[0]),
                               tilt * glm::dot(at.from, frame[1]),
                               -away.x,
                               -away.y,
                               -away.z,
                               -out,
                               -1.0,
                               ring.tube - at.across};
        for (int i = 0; i != 7; ++i)
            for (int k = 0; k != 8; ++k)
                m[i][k] += row[i] * row[k] / double(points.size());
    }
    Step x;
    if (!solve(m, x))
        return false;
    ring.axis = glm::normalize(ring.axis + x[0] * frame[0] + x[1] * frame[1]);
    ring.center += glm::dvec3(x[2], x[3], x[4]);
    ring.radius += x[5];
    ring.tube += x[6];
    return ring.radius > 0.3 * ring.tube && ring.tube > 0.0 && ring.radius < 1e3;
}

/// The arc that has points: where it starts and how far it goes, in radians.
glm::dvec2 arcOf(const Ring& ring, const glm::dmat3& frame, const std::vector<glm::dvec3>& points)
{
    std::vector<double> angles;
    for (const glm::dvec3& point : points)
    {
        const glm::dvec3 p = (point - ring.center) * frame;
        angles.push_back(std::atan2(p.y, p.x));
    }
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + glm::two_pi<double>() - angles.back();
    double start = angles.front();
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (angles[i] - angles[i - 1] > widest)
        {
            widest = angles[i] - angles[i - 1];
            start = angles[i];
        }
    return {start, glm::two_pi<double>() - widest};
}

/// Of a point around the ring from where the arc starts, -0.1 to 2 pi - 0.1.
double angleOf(const Ring& ring, const glm::dmat3& frame, double start, const glm::dvec3& point)
{
    const glm::dvec3 p = (point - ring.center) * frame;
    const double angle = std::atan2(p.y, p.x) - start;
    return angle - glm::two_pi<double>() * std::floor((angle + 0.1) / glm::two_pi<double>());
}

/// Whether facets go on from the end of the arc to its start: then it is a whole turn.
bool isClosed(const FitMesh& mesh, const Ring& ring, const glm::dmat3& frame, const glm::dvec2& arc)
{
    if (arc.y < glm::pi<double>())
        return false;
    return std::any_of(mesh.facets.begin(), mesh.facets.end(),
                       [&](const FitMesh::Facet& facet)
                       {
                           bool hasStart = false, hasEnd = false;
                           for (const auto corner : facet.corners)
                           {
                               const double angle =
                                   angleOf(ring, frame, arc.x, mesh.points[corner]);
                               hasStart = hasStart || std::abs(angle) < 1e-3;
                               hasEnd = hasEnd || std::abs(angle - arc.y) < 1e-3;
                           }
                           return hasStart && hasEnd;
                       });
}

/// Whether every facet lies on the tube in steps that are small enough, in a flat end, or across
/// the tube within it.
bool isTube(const FitMesh& mesh, const Ring& ring, const glm::dmat3& frame, const glm::dvec2& arc)
{
    const double tolerance = 4.0 * mesh.noise + Tolerance * ring.tube;
    double area = 0.0;
    for (const FitMesh::Facet& facet : mesh.facets)
    {
        bool onTube = true, atStart = true, atEnd = true, isWithin = true;
        glm::dvec2 way[3];
        glm::dvec3 outward[3];
        for (int k = 0; k != 3; ++k)
        {
            const glm::dvec3& point = mesh.points[facet.corners[k]];
            const ByRing at(ring, point);
            onTube = onTube && std::abs(at.across - ring.tube) <= tolerance;
            way[k] = {at.rho - ring.radius, at.z};
            outward[k] = at.outward;
            const double angle = angleOf(ring, frame, arc.x, point);
            isWithin = isWithin && at.across <= ring.tube + tolerance &&
                       glm::distance(at.outward, outward[0]) * at.rho <= tolerance;
            atStart = atStart && std::abs(angle) * at.rho <= tolerance;
            atEnd = atEnd && std::abs(angle - arc.y) * at.rho <= tolerance;
        }
        if (atStart || atEnd || isWithin)
            continue;
        if (!onTube)
            return false;
        for (int k = 0; k != 3; ++k)
            // Less than a fifth of a circle from corner to corner, around the tube and along it.
            if (glm::dot(way[k], way[(k + 1) % 3]) < 0.2 * ring.tube * ring.tube ||
                glm::dot(outward[k], outward[(k + 1) % 3]) < 0.25)
                return false;
        area += facet.area;
    }
    return area > LeastCover * glm::two_pi<double>() * ring.tube * ring.radius * arc.y;
}

std::vector<glm::dvec3> sampled(const std::vector<glm::dvec3>& points)
{
    if (points.size() <= MostSamples)
        return points;
    std::vector<glm::dvec3> samples;
    for (std::size_t i = 0; i != MostSamples; ++i)
        samples.push_back(points[i * points.size() / MostSamples]);
    return samples;
}

/// The axis of a bend, given the direction of its tube halfway: along the tube normals lean the
/// more that way the more they face in or out of the bend.
std::optional<glm::dvec3> bendAxis(const FitMesh& mesh, const glm::dvec3& along)
{
    glm::dvec3 side(0.0);
    const std::size_t stride = strideOf(mesh);
    for (std::size_t i = 0; i < mesh.facets.size(); i += stride)
    {
        const FitMesh::Facet& facet = mesh.facets[i];
        const double lean = glm::dot(facet.normal, along);
        if (std::abs(lean) < 0.6)
            side += facet.area / mesh.area * lean * glm::dot(facet.middle - mesh.centroid, along) *
                    facet.normal;
    }
    const glm::dvec3 axis = glm::cross(along, side);
    const double length = glm::length(axis);
    return length > 1e-9 ? std::optional<glm::dvec3>(axis / length) : std::nullopt;
}

/// Root mean square distance of points from the tube.
double spread(const Ring& ring, const std::vector<glm::dvec3>& points)
{
    double sum = 0.0;
    for (const glm::dvec3& point : points)
    {
        const double off = ByRing(ring, point).across - ring.tube;
        sum += off * off;
    }
    return std::sqrt(sum / double(points.size()));
}

std::optional<FittedShape> fitAround(const FitMesh& mesh, const std::vector<glm::dvec3>& samples,
                                     std::optional<Ring> ring)
{
    if (!ring || spread(*ring, samples) > 0.5 * ring->tube)
        return std::nullopt;
    for (int i = 0; i != 12; ++i)
    {
        const Ring before = *ring;
        if (!improve(*ring, samples))
            return std::nullopt;
        if (glm::distance(before.center, ring->center) + std::abs(before.tube - ring->tube) < 1e-9)
            break;
    }
    const double tolerance = 4.0 * mesh.noise + Tolerance * ring->tube;
    if (ring->tube <= 20.0 * mesh.noise)
        return std::nullopt;
    for (const glm::dvec3& point : samples)
    {
        const double across = ByRing(*ring, point).across;
        if (across > ring->tube + tolerance ||
            (across > 0.7 * ring->tube && across < ring->tube - tolerance))
            return std::nullopt;
    }
    glm::dmat3 frame = frameAround(ring->axis);
    glm::dvec2 arc = arcOf(*ring, frame, mesh.points);
    if (isClosed(mesh, *ring, frame, arc))
        arc.y = glm::two_pi<double>();
    if (arc.y < 0.02 || !isTube(mesh, *ring, frame, arc))
        return std::nullopt;
    const glm::dvec3 x = std::cos(arc.x) * frame[0] + std::sin(arc.x) * frame[1];
    frame = {x, glm::cross(frame[2], x), frame[2]};
    return makeShape(mesh, Shape::Torus, frame, ring->center, {ring->radius, ring->tube, arc.y});
}

} // namespace

std::optional<FittedShape> fitElbow(const FitMesh& mesh)
{
    // Boxy things are many, and no bends.
    if (mesh.facets.size() < 10 || (!mesh.curved && mesh.directions.size() < 5))
        return std::nullopt;
    const std::vector<glm::dvec3> samples = sampled(mesh.points);
    for (int i = 0; i != 3; ++i)
        if (const auto axis = bendAxis(mesh, mesh.axes[i]))
            if (auto elbow =
                    fitAround(mesh, samples, guessRing(mesh, samples, *axis, mesh.axes[i])))
                return elbow;
    // Bends of half a circle and more have normals all around.
    for (int i = 0; i != 3; ++i)
        if (auto elbow =
                fitAround(mesh, samples, guessRing(mesh, samples, mesh.axes[i], glm::dvec3(0.0))))
            return elbow;
    return std::nullopt;
}

} // namespace osgLabels
