// SPDX-License-Identifier: MIT
#include "PlacedShapes.h"

#include <osgLabels/Placement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <random>

using namespace osgLabels;

namespace
{

/// A camera that looks at the origin from somewhere.
struct Camera
{
    Camera(const glm::dvec3& from, const glm::dvec3& worldUp) : eye(from), up(worldUp)
    {
        const glm::dvec3 back = glm::normalize(from);
        right = glm::normalize(glm::cross(worldUp, back));
        above = glm::cross(back, right);
    }

    PlacementView view() const
    {
        PlacementView made;
        made.eye = glm::vec4(glm::vec3(eye), 1.0f);
        made.up = glm::vec3(up);
        made.screenUp = glm::vec3(above);
        made.screenRight = glm::vec3(right);
        return made;
    }

    /// What a point of a surface moves by for a step on the screen, to the first order.
    glm::dvec3 slide(const glm::dvec3& point, const glm::dvec3& normal,
                     const glm::dvec3& step) const
    {
        const glm::dvec3 ray = point - eye;
        return step - glm::dot(step, normal) / glm::dot(ray, normal) * ray;
    }

    /// On the screen, whatever its scale.
    glm::dvec2 project(const glm::dvec3& point) const
    {
        const glm::dvec3 ray = point - eye;
        return glm::dvec2(glm::dot(ray, right), glm::dot(ray, above)) /
               -glm::dot(ray, glm::cross(right, above));
    }

    glm::dvec3 eye, up, right, above;
};

struct Sample
{
    glm::dvec3 point, normal;
    bool curved; ///< Not of a flat end.
};

/// The outward normal of the curved side of a shape in its frame.
glm::dvec3 sideNormal(const FittedShape& shape, const glm::dvec3& p)
{
    const double rho = std::hypot(p.x, p.y);
    const glm::dvec3 out(p.x / rho, p.y / rho, 0.0);
    switch (shape.shape)
    {
    case Shape::Cylinder:
        return out;
    case Shape::Frustum:
        return glm::normalize(2.0 * shape.size.z * out +
                              glm::dvec3(0, 0, shape.size.x - shape.size.y));
    case Shape::Sphere:
        return glm::normalize(p);
    case Shape::Dish:
        return glm::normalize(p / (shape.size * shape.size));
    default:
        return glm::normalize((rho - shape.size.x) * out + glm::dvec3(0, 0, p.z));
    }
}

bool isRound(Shape shape)
{
    return shape == Shape::Cylinder || shape == Shape::Frustum || shape == Shape::Sphere ||
           shape == Shape::Dish || shape == Shape::Torus;
}

/// Onto the curved side, from nearby.
glm::dvec3 settle(const FittedShape& shape, glm::dvec3 p)
{
    for (int i = 0; i != 3; ++i)
    {
        const glm::dvec3 n = sideNormal(shape, p);
        const double off = distanceTo(shape, p);
        const glm::dvec3 in = p - off * n, out = p + off * n;
        p = distanceTo(shape, in) < distanceTo(shape, out) ? in : out;
    }
    return p;
}

/// A random point of the surface; of the shape itself where that is round.
class Sampler
{
public:
    explicit Sampler(const ShapeMesh& mesh) : _mesh(mesh)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            _sums.push_back(sum += glm::length(cross(i)));
    }

    Sample operator()(std::mt19937& random) const
    {
        std::uniform_real_distribution<double> unit;
        const double at = unit(random) * _sums.back();
        const std::size_t i =
            3 * std::size_t(std::lower_bound(_sums.begin(), _sums.end(), at) - _sums.begin());
        double u = unit(random), v = unit(random);
        if (u + v > 1.0)
        {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const glm::dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
        Sample sample{a + u * (b - a) + v * (c - a), glm::normalize(cross(i)), false};
        const FittedShape& shape = _mesh.truth;
        if (!isRound(shape.shape))
            return sample;
        const glm::dvec3 side = sideNormal(shape, sample.point);
        sample.curved = glm::dot(side, sample.normal) > 0.9;
        if (sample.curved)
        {
            sample.point = settle(shape, sample.point);
            sample.normal = sideNormal(shape, sample.point);
        }
        return sample;
    }

private:
    glm::dvec3 corner(std::size_t i) const { return _mesh.points[_mesh.indices[i]]; }
    glm::dvec3 cross(std::size_t i) const
    {
        return glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i));
    }

    const ShapeMesh& _mesh;
    std::vector<double> _sums;
};

LabelPlace placeAt(const ShapeMesh& mesh, const Sample& sample, const Camera& camera, float width,
                   double pixel = 1e-3)
{
    const glm::dvec3 dx = pixel * camera.slide(sample.point, sample.normal, camera.right);
    const glm::dvec3 dy = pixel * camera.slide(sample.point, sample.normal, camera.above);
    return placeOn(mesh.truth.record(1), glm::vec3(sample.point - mesh.truth.origin), glm::vec3(dx),
                   glm::vec3(dy), camera.view(), width);
}

/// As seen from right above: also where the camera looks along the surface, or at its back.
LabelPlace placeFromAbove(const ShapeMesh& mesh, const Sample& sample, const Camera& camera,
                          float width, const glm::dmat2x3& tangents)
{
    return placeOn(mesh.truth.record(1), glm::vec3(sample.point - mesh.truth.origin),
                   glm::vec3(tangents[0]), glm::vec3(tangents[1]), camera.view(), width);
}

/// Moves a sample over the surface to another place of its label. False where the surface ends
/// before, or the label.
bool walk(const ShapeMesh& mesh, Sample& sample, const Camera& camera, float width,
          const glm::dvec2& target)
{
    constexpr int Steps = 64;
    const double reach = glm::length(mesh.truth.size);
    for (int i = 0; i <= Steps; ++i)
    {
        const glm::dvec3 side =
            std::abs(sample.normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 across = glm::normalize(glm::cross(sample.normal, side));
        const glm::dmat2x3 tangents(1e-3 * glm::cross(across, sample.normal), 1e-3 * across);
        const LabelPlace at = placeFromAbove(mesh, sample, camera, width, tangents);
        // Steps on curved surfaces do not arrive exactly.
        if (i == Steps)
            return glm::distance(target, glm::dvec2(at.place)) < 0.02 &&
                   distanceTo(mesh.truth, sample.point) < 1e-4 * reach;
        sample.point += tangents * (glm::inverse(glm::dmat2(at.footprint)) *
                                    (target - glm::dvec2(at.place)) / double(Steps - i));
        if (sample.curved)
        {
            sample.point = settle(mesh.truth, sample.point);
            sample.normal = sideNormal(mesh.truth, sample.point);
        }
        if (distanceTo(mesh.truth, sample.point) > 1e-4 * reach)
            return false;
    }
    return false;
}

glm::dvec3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<double> gauss;
    return glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
}

Camera randomCamera(std::mt19937& random, const ShapeMesh& mesh)
{
    std::uniform_real_distribution<double> distance(2.5, 6.0);
    double reach = 0.0;
    for (const glm::dvec3& point : mesh.points)
        reach = std::max(reach, glm::length(point));
    return Camera(distance(random) * reach * randomDirection(random),
                  random() % 2 ? glm::dvec3(0, 0, 1) : randomDirection(random));
}

/// Whether the sample is seen at more than that sine of an angle.
bool faces(const Camera& camera, const Sample& sample, double least = 0.05)
{
    const glm::dvec3 to = camera.eye - sample.point;
    return std::abs(glm::dot(to, sample.normal)) > least * glm::length(to);
}

/// Calls what(shape, sample, camera, width, place) for points that lie on text.
template <class What> void forText(int samples, const What& what)
{
    std::mt19937 random(3);
    for (const PlacedShape& shape : placedShapes())
        for (const float width : {1.0f, shape.width, 25.0f})
        {
            const Sampler sampler(shape.mesh);
            int found = 0;
            for (int i = 0; i != samples; ++i)
            {
                const Camera camera = randomCamera(random, shape.mesh);
                const Sample sample = sampler(random);
                if (!faces(camera, sample))
                    continue;
                const LabelPlace place = placeAt(shape.mesh, sample, camera, width);
                if (!place.inside)
                    continue;
                ++found;
                what(shape, sample, camera, width, place);
            }
            EXPECT_GT(found, 0) << shape.name << " has no text of " << width << " em";
        }
}

/// The largest and smallest length on the surface of one em.
glm::dvec2 lengthsOfEm(const Sample& sample, const Camera& camera, const LabelPlace& place)
{
    const glm::dvec3 dx = 1e-3 * camera.slide(sample.point, sample.normal, camera.right);
    const glm::dvec3 dy = 1e-3 * camera.slide(sample.point, sample.normal, camera.above);
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(place.footprint));
    const glm::dvec3 a = inverse[0].x * dx + inverse[0].y * dy;
    const glm::dvec3 b = inverse[1].x * dx + inverse[1].y * dy;
    const double sum = 0.5 * (glm::dot(a, a) + glm::dot(b, b));
    const double root = std::hypot(0.5 * (glm::dot(a, a) - glm::dot(b, b)), glm::dot(a, b));
    return {std::sqrt(sum + root), std::sqrt(std::max(0.0, sum - root))};
}

bool isDevelopable(Shape shape)
{
    return shape != Shape::Sphere && shape != Shape::Dish && shape != Shape::Torus;
}

} // namespace

TEST(PlacementTest, textLiesWithinItsFace)
{
    int walked = 0;
    forText(400,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                for (const glm::dvec2 corner :
                     {glm::dvec2(0.01, 0.01), glm::dvec2(width - 0.01, 0.01),
                      glm::dvec2(0.01, 0.99), glm::dvec2(width - 0.01, 0.99)})
                {
                    Sample at = sample;
                    EXPECT_TRUE(walk(shape.mesh, at, camera, width, corner))
                        << shape.name << ", " << width << " em: no corner " << corner.x << ' '
                        << corner.y << " from " << place.place.x << ' ' << place.place.y;
                    ++walked;
                }
            });
    std::cout << walked << " corners of texts reached\n";
}

TEST(PlacementTest, pointsOnTheLineAreOnTheTextAndTheSameFromAllOfIt)
{
    int walked = 0;
    forText(400,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                const double em = lengthsOfEm(sample, camera, place).x;
                Sample other = sample;
                if (!walk(shape.mesh, other, camera, width, {0.1 * width, 0.2}))
                    return;
                const LabelPlace there = placeAt(shape.mesh, other, camera, width);
                const double side = glm::distance(place.onLine[0], there.onLine[0]) <
                                            glm::distance(place.onLine[2], there.onLine[0])
                                        ? 1.0
                                        : -1.0;
                for (int i = 0; i < 3; ++i)
                {
                    // The one end of the line where the other is the text's start.
                    const int j = side > 0.0 ? i : 2 - i;
                    EXPECT_LT(glm::distance(place.onLine[i], there.onLine[j]), 1e-3 * em)
                        << shape.name << ", " << width << " em: point " << i;
                    Sample at = sample;
                    // A profile has its lines on the box around it.
                    if (shape.mesh.truth.shape == Shape::Extrusion ||
                        !walk(shape.mesh, at, camera, width, {(i + 0.5) / 3.0 * width, 0.5}))
                        continue;
                    // walk() comes within 0.02 em; a dish has its line on a cone that touches it.
                    const double least = std::min(glm::distance(at.point - shape.mesh.truth.origin,
                                                                glm::dvec3(place.onLine[i])),
                                                  glm::distance(at.point - shape.mesh.truth.origin,
                                                                glm::dvec3(place.onLine[2 - i])));
                    EXPECT_LT(least, shape.mesh.truth.shape == Shape::Dish ? 0.3 * em : 0.05 * em)
                        << shape.name << ", " << width << " em: point " << i;
                    ++walked;
                }
            });
    EXPECT_GT(walked, 1000);
}

TEST(PlacementTest, developableShapesDoNotStretchText)
{
    std::map<std::string, double> worst;
    forText(1500,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float,
                const LabelPlace& place)
            {
                const glm::dvec2 em = lengthsOfEm(sample, camera, place);
                double& stretch = worst[shape.name];
                stretch = std::max(stretch, em.x / em.y - 1.0);
            });
    for (const PlacedShape& shape : placedShapes())
    {
        std::cout << std::setw(12) << shape.name << ": stretched by at most "
                  << 100.0 * worst[shape.name] << " %\n";
        // Spheres and dishes can't be unrolled, nor can bends, which are narrower inside.
        EXPECT_LT(worst[shape.name], isDevelopable(shape.mesh.truth.shape) ? 0.01 : 0.07)
            << shape.name;
    }
}

TEST(PlacementTest, footprintsAreDerivatives)
{
    forText(300,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                for (int i = 0; i != 2; ++i)
                {
                    const glm::dvec3 step = camera.slide(sample.point, sample.normal,
                                                         i == 0 ? camera.right : camera.above);
                    // A tenth of an em: more than floats' noise, less than curvature.
                    const double length = 0.1 * 1e-3 / glm::length(glm::dvec2(place.footprint[i]));
                    Sample before = sample, after = sample;
                    before.point -= 0.5 * length * step;
                    after.point += 0.5 * length * step;
                    const LabelPlace a = placeAt(shape.mesh, before, camera, width);
                    const LabelPlace b = placeAt(shape.mesh, after, camera, width);
                    const glm::dvec2 moved = glm::dvec2(b.place) - glm::dvec2(a.place);
                    const glm::dvec2 expected = glm::dvec2(place.footprint[i]) * length / 1e-3;
                    // Where the points lie on two texts there is no derivative.
                    if (glm::length(moved) > 0.2)
                        continue;
                    EXPECT_LT(glm::distance(moved, expected), 0.004)
                        << shape.name << ", " << width << " em";
                }
            });
}

TEST(PlacementTest, textIsUprightAndNotMirrored)
{
    double lowest = 180.0, highest = -180.0;
    forText(1500,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                EXPECT_GT(glm::determinant(place.footprint), 0.0f) << shape.name;
                // Bends and spheres turn within a text, the more on the screen the flatter they
                // are seen: what counts is its middle.
                if (std::abs(place.place.x - 0.5f * width) > 0.2f || !faces(camera, sample, 0.2))
                    return;
                const LabelPlace at = placeAt(shape.mesh, sample, camera, width);
                const glm::dmat2 inverse = glm::inverse(glm::dmat2(at.footprint));
                const glm::dvec2 pixels = inverse * glm::dvec2(0.01, 0.0);
                const glm::dvec3 next =
                    sample.point +
                    1e-3 * (pixels.x * camera.slide(sample.point, sample.normal, camera.right) +
                            pixels.y * camera.slide(sample.point, sample.normal, camera.above));
                const glm::dvec2 way = camera.project(next) - camera.project(sample.point);
                const double angle = glm::degrees(std::atan2(way.y, way.x));
                lowest = std::min(lowest, angle);
                highest = std::max(highest, angle);
                // The window is -67.5 to 112.5 for the line's middle; a line's edges, half an em
                // away, may lie a little differently in perspective.
                EXPECT_GT(angle, -85.0) << shape.name << ", " << width << " em";
                EXPECT_LT(angle, 130.0) << shape.name << ", " << width << " em";
            });
    std::cout << "text runs at " << lowest << " to " << highest << " degrees\n";
}

TEST(PlacementTest, noDecisionTremblesWithTheCamera)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> tremble(-1e-6, 1e-6);
    // The views that a user has most: along axes, diagonal, from above.
    const std::vector<glm::dvec3> from = {{0, -1, 0}, {1, 0, 0},  {1, 1, 0},         {1, -1, 1},
                                          {0, -1, 1}, {-1, 0, 1}, {0.001, -0.001, 1}};
    for (const PlacedShape& shape : placedShapes())
        for (const glm::dvec3& direction : from)
            for (int i = 0; i != 300; ++i)
            {
                const Sampler sampler(shape.mesh);
                const Sample sample = sampler(random);
                const double reach = glm::length(glm::min(shape.mesh.truth.size, glm::dvec3(4.0)));
                const glm::dvec3 eye = 4.0 * reach * glm::normalize(direction);
                const Camera still(eye, {0, 0, 1});
                if (!faces(still, sample))
                    continue;
                const LabelPlace a = placeAt(shape.mesh, sample, still, shape.width);
                if (!a.inside)
                    continue;
                for (int k = 0; k != 8; ++k)
                {
                    const glm::dvec3 off(tremble(random), tremble(random), tremble(random));
                    const Camera moved(eye + reach * off, {0, 0, 1});
                    const LabelPlace b = placeAt(shape.mesh, sample, moved, shape.width);
                    // Bends that reach over the top are seen at every angle, so some text there
                    // is just about to turn over.
                    if (shape.mesh.truth.shape != Shape::Torus)
                    {
                        EXPECT_LT(glm::distance(a.place, b.place), 1e-3) << shape.name;
                    }
                }
            }
}

TEST(PlacementTest, fiveMillionTextsAlongAPipeAreExactNearTheEye)
{
    // 1e-3 thick, 1e4 long.
    ShapeMesh mesh = shapemesh::frustum(5e-4, 5e-4, 5e3, 16, 1, shapemesh::Open);
    const ObjectRecord record = mesh.truth.record(1);
    PlacementView view;
    view.up = glm::vec3(0, 1, 0);
    const float width = 3.0f;
    for (const float along : {0.0f, 12.5f, 777.25f, -4321.5f, 4999.0f})
    {
        view.base = glm::vec3(0.0f, 0.0f, along);
        view.eye = glm::vec4(0.3f, 0.0f, along, 1.0f);
        view.screenRight = glm::vec3(0, 0, -1);
        view.screenUp = glm::vec3(0, 1, 0);
        float travelled = 0.0f;
        LabelPlace before;
        const float em = 0.5f * 1.57079633f * 5e-4f;
        for (int i = 0; i != 1000; ++i)
        {
            const float z = 0.01f * float(i) * em;
            const LabelPlace at =
                placeOn(record, {5e-4f, 0.0f, z}, {0, 0, -1e-6f}, {0, 1e-6f, 0}, view, width);
            EXPECT_NEAR(at.place.y, 0.5f, 1e-4f);
            if (i > 0 && at.place.x < before.place.x)
                travelled += before.place.x - at.place.x;
            before = at;
        }
        // Ten em, of which two steps from one text to the next go the other way.
        EXPECT_NEAR(travelled, 10.0f, 0.05f) << along;
    }
    // The same points from two bases, exact in floats both: the same place on the text.
    for (const float em : {3.0f, 3.7f, 11.3f})
        for (const float base : {100.0f, 1000.0f, 4096.0f})
            for (const float apart : {0x1p-5f, 1.0f, 3.0f, 7.0f, 13.0f, 16.0f})
            {
                view.base.z = base;
                const LabelPlace a =
                    placeOn(record, {5e-4f, 0, apart}, {0, 0, -1e-6f}, {0, 1e-6f, 0}, view, em);
                view.base.z = base + apart;
                const LabelPlace b =
                    placeOn(record, {5e-4f, 0, 0}, {0, 0, -1e-6f}, {0, 1e-6f, 0}, view, em);
                EXPECT_LT(glm::distance(a.place, b.place), 0.05f) << base << ' ' << apart;
            }
}

TEST(PlacementTest, thinAndLongFacesKeepTheirText)
{
    // A face of 1e-3 x 1e4 seen from near its end.
    FittedShape shape;
    shape.shape = Shape::Box;
    shape.size = {5e3, 5e-4, 5e-4};
    PlacementView view;
    view.base = glm::vec3(4321.0f, 0.0f, 0.0f);
    view.eye = glm::vec4(4321.0f, -0.01f, 0.0f, 1.0f);
    view.screenRight = glm::vec3(1, 0, 0);
    view.screenUp = glm::vec3(0, 0, 1);
    view.up = glm::vec3(0, 0, 1);
    int inside = 0;
    for (int i = 0; i != 1000; ++i)
    {
        const LabelPlace at = placeOn(shape.record(1), {1e-5f * float(i), -5e-4f, 0.0f},
                                      {1e-7f, 0, 0}, {0, 0, 1e-7f}, view, 8.0f);
        inside += at.inside;
        EXPECT_NEAR(at.footprint[0].x, 1e-7f / 5e-4f, 1e-6f);
    }
    // Eight em of text and at least two of gap, half of 1e-3 tall.
    EXPECT_NEAR(inside, 800, 20);
}

TEST(PlacementTest, shortTextsAreRepeatedAlongWhatIsLongAndStandOnceOnWhatIsNot)
{
    using namespace shapemesh;
    struct Case
    {
        const char* name;
        ShapeMesh mesh;
        glm::dvec3 normal; ///< Of the side where the text is looked at.
        bool isLong;
    };
    const Case cases[] = {{"pipe", frustum(0.1, 0.1, 6.0, 32, 1, FanCapped), {0, 1, 0}, true},
                          {"pole", frustum(0.2, 0.2, 1.2, 32, 1, FanCapped), {0, 1, 0}, true},
                          {"tank", frustum(0.5, 0.5, 0.6, 32, 1, FanCapped), {0, 1, 0}, false},
                          {"rail", box({0.1, 0.2, 4.0}, false), {0, 1, 0}, true},
                          {"post", box({0.1, 0.1, 0.4}, false), {0, 1, 0}, true},
                          {"block", box({0.5, 0.5, 0.7}, false), {0, 1, 0}, false}};
    for (const Case& each : cases)
        for (const float width : {0.6f, 1.2f, 1.8f, 2.4f})
            for (const glm::dvec3 up : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)})
            {
                const Camera camera(glm::dvec3(1.0, 8.0, 1.5), up);
                const glm::dvec3 size = each.mesh.truth.size;
                bool runsAlong = false;
                int texts = 0;
                double last = 1e9;
                for (double z = -size.z; z < size.z; z += 0.002 * size.x)
                {
                    const Sample sample{each.normal * size.y + glm::dvec3(0, 0, z), each.normal,
                                        false};
                    const LabelPlace at = placeAt(each.mesh, sample, camera, width);
                    if (!at.inside)
                        continue;
                    // Along the text, seen from below to above.
                    const glm::dvec2 step =
                        glm::dvec2(at.footprint *
                                   glm::vec2(camera.project(sample.point + glm::dvec3(0, 0, 1e-3)) -
                                             camera.project(sample.point)));
                    runsAlong = std::abs(step.x) > std::abs(step.y);
                    texts += std::abs(at.place.x - last) > 0.5 * width;
                    last = at.place.x;
                }
                const std::string what = std::string(each.name) + ", " + std::to_string(width) +
                                         " em, up " + (up.z > 0.0 ? "z" : "x");
                if (each.isLong)
                {
                    EXPECT_TRUE(runsAlong) << what;
                    EXPECT_GE(texts, width < 2.0f ? 2 : 1) << what;
                }
                else if (up.z > 0.0 && width < 2.0f)
                {
                    EXPECT_FALSE(runsAlong) << what;
                }
            }
}

TEST(PlacementTest, badObjectsHaveNoText)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    PlacementView view;
    view.eye = glm::vec4(1, 2, 3, 1);
    for (std::uint32_t shape = 0; shape != 12; ++shape)
        for (const float size : {0.0f, 1e-38f, nan, infinite, -1.0f})
            for (const float width : {0.0f, nan, -1.0f, 5.0f})
                for (const glm::vec3 at : {glm::vec3(0.0f), glm::vec3(0.1f, 0.2f, 0.3f)})
                    for (const glm::vec3 step : {glm::vec3(0.0f), glm::vec3(1e-3f, 0, 0)})
                    {
                        ObjectRecord record;
                        record.shape = shape;
                        record.size = glm::vec3(size, size, size);
                        const LabelPlace place =
                            placeOn(record, at, step, {0, 1e-3f, 0}, view, width);
                        if (place.inside)
                        {
                            EXPECT_TRUE(std::isfinite(place.place.x + place.place.y));
                            EXPECT_GT(width, 0.0f);
                            EXPECT_NE(shape, 0u);
                        }
                    }
}
