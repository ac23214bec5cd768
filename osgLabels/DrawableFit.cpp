// SPDX-License-Identifier: MIT
#include <osgLabels/DrawableFit.h>

#include <osg/Geometry>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osg/TriangleFunctor>
#include <osg/TriangleIndexFunctor>

#include <algorithm>

namespace osgLabels
{

namespace
{

struct IndexedTriangles
{
    std::vector<std::uint32_t> indices;

    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        indices.insert(indices.end(), {a, b, c});
    }
};

struct LooseTriangles
{
    std::vector<glm::vec3> vertices;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false)
    {
        for (const osg::Vec3* v : {&a, &b, &c})
            vertices.emplace_back(v->x(), v->y(), v->z());
    }
};

/// Vertices of double are moved to their box's middle before they become floats.
glm::dvec3 readVertices(const osg::Array& array, std::vector<glm::vec3>& vertices)
{
    const auto read = [&](const auto& from)
    {
        vertices.reserve(from.size());
        for (const auto& v : from)
            vertices.emplace_back(float(v[0]), float(v[1]), float(v[2]));
    };
    if (const auto* floats = dynamic_cast<const osg::Vec3Array*>(&array))
        read(*floats);
    else if (const auto* four = dynamic_cast<const osg::Vec4Array*>(&array))
        for (const osg::Vec4& v : *four)
            vertices.emplace_back(v.x() / v.w(), v.y() / v.w(), v.z() / v.w());
    else if (const auto* two = dynamic_cast<const osg::Vec2Array*>(&array))
        for (const osg::Vec2& v : *two)
            vertices.emplace_back(v.x(), v.y(), 0.0f);
    else if (const auto* doubles = dynamic_cast<const osg::Vec3dArray*>(&array))
    {
        const osg::Vec3d first = doubles->empty() ? osg::Vec3d() : doubles->front();
        for (const osg::Vec3d& v : *doubles)
            vertices.emplace_back(float(v.x() - first.x()), float(v.y() - first.y()),
                                  float(v.z() - first.z()));
        return {first.x(), first.y(), first.z()};
    }
    else if (const auto* shorts = dynamic_cast<const osg::Vec3sArray*>(&array))
        read(*shorts);
    return glm::dvec3(0.0);
}

FittedShape fitGeometry(const osg::Geometry& geometry)
{
    const osg::Array* array = geometry.getVertexArray();
    // As osg::Geometry itself: generic attribute 0 is the position.
    if ((!array || array->getNumElements() == 0) && geometry.getNumVertexAttribArrays() > 0)
        array = geometry.getVertexAttribArray(0);
    if (!array)
        return {};
    std::vector<glm::vec3> vertices;
    const glm::dvec3 moved = readVertices(*array, vertices);
    osg::TriangleIndexFunctor<IndexedTriangles> triangles;
    for (unsigned int i = 0; i != geometry.getNumPrimitiveSets(); ++i)
        geometry.getPrimitiveSet(i)->accept(triangles);
    FittedShape shape = fitShape(vertices, triangles.indices);
    shape.origin += moved;
    return shape;
}

FittedShape fitTriangles(const osg::Drawable& drawable)
{
    osg::TriangleFunctor<LooseTriangles> triangles;
    if (!drawable.supports(triangles))
        return {};
    drawable.accept(triangles);
    std::vector<std::uint32_t> indices(triangles.vertices.size());
    for (std::size_t i = 0; i != indices.size(); ++i)
        indices[i] = std::uint32_t(i);
    return fitShape(triangles.vertices, indices);
}

/// What an osg::Shape says of itself; None for those that only have triangles.
class ReadShape : public osg::ConstShapeVisitor
{
public:
    FittedShape shape;

    void apply(const osg::Sphere& sphere) override
    {
        place(Shape::Sphere, sphere.getCenter(), osg::Quat(),
              glm::dvec3(std::abs(sphere.getRadius())));
    }
    void apply(const osg::Box& box) override
    {
        const osg::Vec3 half = box.getHalfLengths();
        place(Shape::Box, box.getCenter(), box.getRotation(),
              glm::abs(glm::dvec3(half.x(), half.y(), half.z())));
    }
    void apply(const osg::Cylinder& cylinder) override
    {
        const double radius = std::abs(cylinder.getRadius());
        place(Shape::Cylinder, cylinder.getCenter(), cylinder.getRotation(),
              {radius, radius, 0.5 * std::abs(cylinder.getHeight())});
    }
    void apply(const osg::Cone& cone) override
    {
        const osg::Vec3 middle(0.0f, 0.0f, 0.5f * cone.getHeight() + cone.getBaseOffset());
        place(Shape::Frustum, cone.getCenter() + cone.getRotation() * middle, cone.getRotation(),
              {std::abs(cone.getRadius()), 0.0, 0.5 * std::abs(cone.getHeight())});
    }
    void apply(const osg::Capsule& capsule) override
    {
        const double radius = std::abs(capsule.getRadius());
        place(Shape::Cylinder, capsule.getCenter(), capsule.getRotation(),
              {radius, radius, 0.5 * std::abs(capsule.getHeight())});
        shape.projected = true;
    }

private:
    void place(Shape kind, const osg::Vec3& center, const osg::Quat& rotation,
               const glm::dvec3& size)
    {
        shape.shape = kind;
        shape.origin = {center.x(), center.y(), center.z()};
        // OSG's rotates the shape into local coordinates.
        shape.rotation = glm::inverse(
            glm::normalize(glm::dquat(rotation.w(), rotation.x(), rotation.y(), rotation.z())));
        shape.size = size;
    }
};

bool isSound(const FittedShape& shape)
{
    const glm::dvec3 all = shape.origin + shape.size;
    return shape.shape != Shape::None && std::isfinite(all.x + all.y + all.z) &&
           std::isfinite(glm::dot(shape.rotation, shape.rotation)) &&
           std::max({shape.size.x, shape.size.y, shape.size.z}) > 0.0;
}

} // namespace

FittedShape fitDrawable(const osg::Drawable& drawable)
{
    if (const auto* shaped = dynamic_cast<const osg::ShapeDrawable*>(&drawable))
        if (shaped->getShape())
        {
            ReadShape read;
            shaped->getShape()->accept(read);
            if (isSound(read.shape))
                return read.shape;
        }
    if (const osg::Geometry* geometry = drawable.asGeometry())
        return fitGeometry(*geometry);
    return fitTriangles(drawable);
}

} // namespace osgLabels
