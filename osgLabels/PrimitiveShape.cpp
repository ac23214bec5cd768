// SPDX-License-Identifier: MIT
#include <osgLabels/PrimitiveShape.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// By the conjugate of `rotation`: from the shape's frame to local coordinates.
glm::vec3 unrotate(const glm::quat& rotation, const glm::vec3& v)
{
    const glm::vec3 axis(-rotation.x, -rotation.y, -rotation.z);
    return v + 2.0f * glm::cross(axis, glm::cross(axis, v) + rotation.w * v);
}

/// The unit mesh has x along the turn from 0 to 1, y and z around the tube.
SurfacePoint onTorus(const glm::vec3& size, const SurfacePoint& unit)
{
    const float angle = unit.position.x * size.z;
    const glm::vec3 out(std::cos(angle), std::sin(angle), 0.0f), up(0.0f, 0.0f, 1.0f);
    const glm::vec3 along(-out.y, out.x, 0.0f);
    return {out * (size.x + size.y * unit.position.y) + up * (size.y * unit.position.z),
            along * unit.normal.x + out * unit.normal.y + up * unit.normal.z};
}

/// Of the side: radial in xy; of the ends: along z.
SurfacePoint onFrustum(const glm::vec3& size, const SurfacePoint& unit)
{
    const float t = 0.5f * (unit.position.z + 1.0f);
    const float radius = size.x + (size.y - size.x) * t;
    const bool side = unit.normal.z == 0.0f;
    const glm::vec3 n = unit.normal;
    return {{unit.position.x * radius, unit.position.y * radius, unit.position.z * size.z},
            side ? glm::vec3(n.x * 2.0f * size.z, n.y * 2.0f * size.z, size.x - size.y) : n};
}

/// Normals by the cofactors of the scale, so that a size may be 0.
SurfacePoint scaled(const glm::vec3& size, const SurfacePoint& unit)
{
    const float largest = std::max(std::max(size.x, size.y), size.z);
    const glm::vec3 s = largest > 0.0f ? size / largest : glm::vec3(0.0f);
    return {unit.position * size, unit.normal * glm::vec3(s.y * s.z, s.z * s.x, s.x * s.y)};
}

SurfacePoint inShapeFrame(const ObjectRecord& record, const SurfacePoint& unit)
{
    switch (shapeOf(record))
    {
    case Shape::Torus:
        return onTorus(record.size, unit);
    case Shape::Frustum:
        return onFrustum(record.size, unit);
    default:
        return scaled(record.size, unit);
    }
}

ShapeBox torusBox(const glm::vec3& size)
{
    constexpr float quarter = glm::half_pi<float>();
    const float turn = std::min(size.z, 4.0f * quarter);
    glm::vec3 low(std::min(1.0f, std::cos(turn)), std::min(0.0f, std::sin(turn)), 0.0f);
    glm::vec3 high(1.0f, std::max(0.0f, std::sin(turn)), 0.0f);
    high.y = turn >= quarter ? 1.0f : high.y;
    low.x = turn >= 2.0f * quarter ? -1.0f : low.x;
    low.y = turn >= 3.0f * quarter ? -1.0f : low.y;
    return {low * size.x - size.y, high * size.x + size.y};
}

} // namespace

bool isPrimitive(Shape shape)
{
    return shape >= Shape::Box && shape <= Shape::Extrusion;
}

SurfacePoint placePoint(const ObjectRecord& record, const SurfacePoint& unit)
{
    SurfacePoint point = inShapeFrame(record, unit);
    const float length = glm::length(point.normal);
    point.normal = length > 0.0f ? point.normal / length : glm::vec3(0.0f);
    return {unrotate(record.rotation, point.position) + record.origin,
            unrotate(record.rotation, point.normal)};
}

ShapeBox shapeBox(const ObjectRecord& record)
{
    const glm::vec3& size = record.size;
    switch (shapeOf(record))
    {
    case Shape::Torus:
        return torusBox(size);
    case Shape::Frustum:
    {
        const float radius = std::max(size.x, size.y);
        return {{-radius, -radius, -size.z}, {radius, radius, size.z}};
    }
    case Shape::Dish:
        return {{-size.x, -size.y, 0.0f}, size};
    case Shape::Quad:
        return {{-size.x, -size.y, 0.0f}, {size.x, size.y, 0.0f}};
    default:
        return {-size, size};
    }
}

ShapeBox localBox(const ObjectRecord& record)
{
    const ShapeBox box = shapeBox(record);
    const glm::vec3 half = 0.5f * (box.high - box.low);
    const glm::vec3 center = unrotate(record.rotation, 0.5f * (box.high + box.low)) + record.origin;
    glm::vec3 extent(0.0f);
    for (int axis = 0; axis < 3; ++axis)
    {
        glm::vec3 edge(0.0f);
        edge[axis] = half[axis];
        extent += glm::abs(unrotate(record.rotation, edge));
    }
    return {center - extent, center + extent};
}

float reachOf(const ObjectRecord& record)
{
    const glm::vec3& size = record.size;
    switch (shapeOf(record))
    {
    case Shape::Cylinder:
    case Shape::Frustum:
        return std::hypot(std::max(size.x, size.y), size.z);
    case Shape::Sphere:
    case Shape::Dish:
        return std::max(std::max(size.x, size.y), size.z);
    case Shape::Torus:
        return size.x + size.y;
    case Shape::Quad:
        return std::hypot(size.x, size.y);
    default:
        return glm::length(size);
    }
}

float curveOf(const ObjectRecord& record)
{
    const glm::vec3& size = record.size;
    switch (shapeOf(record))
    {
    case Shape::Cylinder:
    case Shape::Frustum:
        return std::max(size.x, size.y);
    case Shape::Sphere:
    case Shape::Dish:
        return std::max(std::max(size.x, size.y), size.z);
    case Shape::Torus:
        return size.x + size.y;
    default:
        return 0.0f;
    }
}

} // namespace osgLabels
