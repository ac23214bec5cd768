// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/PrimitiveBatch.h>

/// One object of each shape in a row along x, 3 apart, each turned in its own way. `at` is where
/// the first one is.
inline std::vector<osgLabels::Primitive> rowOfShapes(const osg::Vec3d& at = {})
{
    using osgLabels::Shape;
    std::vector<osgLabels::Primitive> row;
    const auto add = [&](Shape shape, const osg::Vec3& size, const char* name)
    {
        osgLabels::Primitive primitive;
        const double i = double(row.size());
        primitive.shape = shape;
        primitive.size = size;
        primitive.position = at + osg::Vec3d(3.0 * i, 0.0, 0.0);
        primitive.rotation.makeRotate(0.4 + 0.7 * i, osg::Vec3d(1.0, 0.3 * i, 0.5));
        primitive.color.set(static_cast<unsigned char>(255 - 20 * row.size()), 160,
                            static_cast<unsigned char>(60 + 20 * row.size()), 255);
        primitive.name = name;
        row.push_back(primitive);
    };
    add(Shape::Box, {1.0f, 0.5f, 0.3f}, "B-101");
    add(Shape::Cylinder, {0.4f, 0.4f, 1.2f}, "10\"-HC-4711-A1B");
    add(Shape::Sphere, {0.9f, 0.9f, 0.9f}, "S-103");
    add(Shape::Dish, {0.9f, 0.9f, 0.5f}, "D-104");
    add(Shape::Frustum, {0.9f, 0.3f, 0.8f}, "R-105");
    add(Shape::Pyramid, {0.7f, 0.9f, 0.8f}, "H-106");
    add(Shape::Torus, {0.8f, 0.25f, 1.57f}, "L-107");
    add(Shape::Torus, {0.9f, 0.04f, 6.2831853f}, "HW-108");
    add(Shape::Quad, {1.0f, 0.6f, 0.0f}, "Q-109");
    add(Shape::Extrusion, {0.3f, 0.3f, 1.2f}, "X-110");
    return row;
}

inline osg::ref_ptr<osgLabels::PrimitiveBatch>
batchOf(const std::vector<osgLabels::Primitive>& primitives)
{
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    for (const osgLabels::Primitive& primitive : primitives)
        batch->add(primitive);
    batch->build();
    return batch;
}
