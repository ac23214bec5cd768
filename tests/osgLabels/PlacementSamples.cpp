// SPDX-License-Identifier: MIT
#include "PlacementSamples.h"

#include <algorithm>
#include <cmath>

using namespace osgLabels;

namespace placement
{

namespace
{

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

/// As seen from right above: also where the camera looks along the surface, or at its back.
LabelPlace placeFromAbove(const ShapeMesh& mesh, const Sample& sample, const Camera& camera,
                          float width, const glm::dmat2x3& tangents)
{
    return placeOn(mesh.truth.record(1), glm::vec3(sample.point - mesh.truth.origin),
                   glm::vec3(tangents[0]), glm::vec3(tangents[1]), camera.view(), width);
}

glm::dvec3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<double> gauss;
    return glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
}

} // namespace

Camera::Camera(const glm::dvec3& from, const glm::dvec3& worldUp) : eye(from), up(worldUp)
{
    const glm::dvec3 back = glm::normalize(from);
    right = glm::normalize(glm::cross(worldUp, back));
    above = glm::cross(back, right);
}

PlacementView Camera::view() const
{
    PlacementView made;
    made.eye = glm::vec4(glm::vec3(eye), 1.0f);
    made.up = glm::vec3(up);
    made.screenUp = glm::vec3(above);
    made.screenRight = glm::vec3(right);
    return made;
}

glm::dvec3 Camera::slide(const glm::dvec3& point, const glm::dvec3& normal,
                         const glm::dvec3& step) const
{
    const glm::dvec3 ray = point - eye;
    return step - glm::dot(step, normal) / glm::dot(ray, normal) * ray;
}

glm::dvec2 Camera::project(const glm::dvec3& point) const
{
    const glm::dvec3 ray = point - eye;
    return glm::dvec2(glm::dot(ray, right), glm::dot(ray, above)) /
           -glm::dot(ray, glm::cross(right, above));
}

Sampler::Sampler(const ShapeMesh& mesh) : _mesh(mesh)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        _sums.push_back(sum += glm::length(cross(i)));
}

Sample Sampler::operator()(std::mt19937& random) const
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

glm::dvec3 Sampler::cross(std::size_t i) const
{
    return glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i));
}

LabelPlace placeAt(const ShapeMesh& mesh, const Sample& sample, const Camera& camera, float width,
                   double pixel)
{
    const glm::dvec3 dx = pixel * camera.slide(sample.point, sample.normal, camera.right);
    const glm::dvec3 dy = pixel * camera.slide(sample.point, sample.normal, camera.above);
    return placeOn(mesh.truth.record(1), glm::vec3(sample.point - mesh.truth.origin), glm::vec3(dx),
                   glm::vec3(dy), camera.view(), width);
}

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

Camera randomCamera(std::mt19937& random, const ShapeMesh& mesh)
{
    std::uniform_real_distribution<double> distance(2.5, 6.0);
    double reach = 0.0;
    for (const glm::dvec3& point : mesh.points)
        reach = std::max(reach, glm::length(point));
    return Camera(distance(random) * reach * randomDirection(random),
                  random() % 2 ? glm::dvec3(0, 0, 1) : randomDirection(random));
}

bool faces(const Camera& camera, const Sample& sample, double least)
{
    const glm::dvec3 to = camera.eye - sample.point;
    return std::abs(glm::dot(to, sample.normal)) > least * glm::length(to);
}

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

} // namespace placement
