// SPDX-License-Identifier: MIT
#include "PlacedShapes.h"

#include <osgLabels/DrawableFit.h>
#include <osgLabels/Placement.h>
#include <osgLabels/TexCoordFit.h>

#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace osgLabels;

namespace
{

/// The same drawable through its triangles alone.
FittedShape fitTessellated(osg::Shape* shape)
{
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry(*drawable);
    return fitDrawable(*geometry);
}

void expectSame(osg::Shape* shape, double tolerance)
{
    osg::ref_ptr<osg::Shape> keep = shape;
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    const FittedShape exact = fitDrawable(*drawable);
    const FittedShape found = fitTessellated(shape);
    EXPECT_EQ(int(found.shape), int(exact.shape)) << shape->className();
    EXPECT_EQ(found.projected, exact.projected) << shape->className();
    EXPECT_LT(glm::distance(found.origin, exact.origin), tolerance) << shape->className();
    EXPECT_LT(found.residual, 1e-4) << shape->className();
    glm::dvec3 a = found.size, b = exact.size;
    std::sort(&a.x, &a.x + 3);
    std::sort(&b.x, &b.x + 3);
    EXPECT_LT(glm::distance(a, b), tolerance) << shape->className();
}

} // namespace

TEST(DrawableFitTest, shapesOfOsgAreFoundFromTheirTrianglesToo)
{
    const osg::Quat turn(0.7, osg::Vec3(1, 2, 3));
    osg::ref_ptr<osg::Box> box = new osg::Box(osg::Vec3(1, 2, 3), 1, 2, 3);
    box->setRotation(turn);
    expectSame(box, 1e-5);
    expectSame(new osg::Sphere(osg::Vec3(1, 2, 3), 2), 1e-4);
    osg::ref_ptr<osg::Cylinder> cylinder = new osg::Cylinder(osg::Vec3(1, 2, 3), 1, 5);
    cylinder->setRotation(turn);
    expectSame(cylinder, 1e-4);
    osg::ref_ptr<osg::Cone> cone = new osg::Cone(osg::Vec3(1, 2, 3), 1, 5);
    cone->setRotation(turn);
    expectSame(cone, 1e-4);
    osg::ref_ptr<osg::ShapeDrawable> capsule =
        new osg::ShapeDrawable(new osg::Capsule(osg::Vec3(1, 2, 3), 1, 5));
    EXPECT_EQ(int(fitDrawable(*capsule).shape), int(Shape::Cylinder));
    EXPECT_TRUE(fitDrawable(*capsule).projected);
}

TEST(DrawableFitTest, verticesOfEveryTypeAreRead)
{
    const ShapeMesh mesh = shapemesh::box({1, 2, 3}, false);
    osg::ref_ptr<osg::Geometry> geometry = geometryOf(mesh);
    const FittedShape floats = fitDrawable(*geometry);
    osg::ref_ptr<osg::Vec3dArray> doubles = new osg::Vec3dArray;
    osg::ref_ptr<osg::Vec4Array> fours = new osg::Vec4Array;
    osg::ref_ptr<osg::Vec3sArray> shorts = new osg::Vec3sArray;
    for (const glm::dvec3& p : mesh.points)
    {
        doubles->push_back(osg::Vec3d(p.x + 1e9, p.y, p.z));
        fours->push_back(osg::Vec4(float(2 * p.x), float(2 * p.y), float(2 * p.z), 2.0f));
        shorts->push_back(osg::Vec3s(short(p.x), short(p.y), short(p.z)));
    }
    geometry->setVertexArray(doubles);
    const FittedShape far = fitDrawable(*geometry);
    EXPECT_LT(glm::distance(far.origin, floats.origin + glm::dvec3(1e9, 0, 0)), 1e-5);
    EXPECT_LT(glm::distance(far.size, floats.size), 1e-5);
    geometry->setVertexArray(fours);
    EXPECT_LT(glm::distance(fitDrawable(*geometry).size, floats.size), 1e-5);
    geometry->setVertexArray(shorts);
    EXPECT_LT(glm::distance(fitDrawable(*geometry).size, floats.size), 1e-5);
    geometry->setVertexArray(nullptr);
    EXPECT_EQ(int(fitDrawable(*geometry).shape), int(Shape::None));
}

TEST(DrawableFitTest, indicesBeyondTheVerticesAreLeftOut)
{
    osg::ref_ptr<osg::Geometry> geometry = geometryOf(shapemesh::box({1, 2, 3}, false));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 20, 3000));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, 8));
    EXPECT_EQ(int(fitDrawable(*geometry).shape), int(Shape::Box));
    osg::ref_ptr<osg::Geometry> lines = geometryOf(shapemesh::box({1, 2, 3}, false));
    lines->removePrimitiveSet(0);
    lines->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, 8));
    EXPECT_EQ(int(fitDrawable(*lines).shape), int(Shape::None));
}

TEST(DrawableFitTest, textFollowsTextureCoordinatesUnstretched)
{
    // 4 by 1, its coordinates from 0 to 2 and from 1 to 2: a unit of s is 2 long, of t 1.
    osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(
        osg::Vec3(5, 0, 0), osg::Vec3(4, 0, 0), osg::Vec3(0, 0, 1), 0.0f, 1.0f, 2.0f, 2.0f);
    const FittedShape fit = fitTexCoords(*geometry, 0);
    ASSERT_EQ(int(fit.shape), int(Shape::TexCoord));
    EXPECT_LT(glm::distance(fit.size, glm::dvec3(2.0, 0.5, 0.0)), 1e-6);
    EXPECT_LT(glm::distance(fit.origin, glm::dvec3(1.0, 1.5, 0.0)), 1e-6);
    const float width = 5.0f;
    const auto at = [&](float s, float t)
    {
        return placeOn(fit.record(1), {s - 1.0f, t - 1.5f, 0.0f}, {0.005f, 0, 0}, {0, 0.01f, 0},
                       PlacementView(), width);
    };
    // One text in the middle, half as tall as the quad.
    EXPECT_TRUE(at(1.0f, 1.5f).inside);
    EXPECT_NEAR(at(1.0f, 1.5f).place.x, 2.5f, 1e-5f);
    EXPECT_NEAR(at(1.0f, 1.74f).place.y, 0.98f, 1e-5f);
    EXPECT_FALSE(at(1.0f, 1.76f).inside);
    // A pixel is 0.01 long both ways: 0.02 em.
    EXPECT_NEAR(at(1.0f, 1.5f).footprint[0].x, 0.02f, 1e-6f);
    EXPECT_NEAR(at(1.0f, 1.5f).footprint[1].y, 0.02f, 1e-6f);
    EXPECT_EQ(int(fitTexCoords(*geometry, 1).shape), int(Shape::None));
    geometry->setTexCoordArray(0, new osg::Vec2Array(4));
    EXPECT_EQ(int(fitTexCoords(*geometry, 0).shape), int(Shape::None));
}

TEST(DrawableFitTest, textureCoordinatesThatAreNotFlatInTheMeshAreToldByItsMiddle)
{
    const auto strip = [](const std::vector<osg::Vec3>& points, const std::vector<float>& s)
    {
        osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        osg::ref_ptr<osg::Vec2Array> at = new osg::Vec2Array;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (const float t : {0.0f, 1.0f})
            {
                vertices->push_back(points[i] + osg::Vec3(0, 0, t));
                at->push_back({s[i], t});
            }
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(vertices);
        geometry->setTexCoordArray(0, at);
        geometry->addPrimitiveSet(
            new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, GLsizei(vertices->size())));
        return fitTexCoords(*geometry, 0);
    };
    const std::vector<float> even{0.0f, 0.5f, 1.0f};
    const FittedShape flat = strip({{0, 3, 0}, {2, 3, 0}, {4, 3, 0}}, even);
    EXPECT_FALSE(flat.bent);
    EXPECT_EQ(flat.record(1).shape, std::uint32_t(Shape::TexCoord));
    const FittedShape folded = strip({{0, 3, 0}, {2, 5, 0}, {4, 3, 0}}, even);
    EXPECT_TRUE(folded.bent);
    EXPECT_EQ(folded.record(1).shape, std::uint32_t(Shape::TexCoord) | osgLabels::Bent);
    // The middle of the surface, and a quarter of the middle one of its lengths, 4, 2 and 1.
    EXPECT_NEAR(folded.rotation.z, 2.0, 1e-6);
    EXPECT_NEAR(folded.rotation.w, 4.0, 1e-6);
    EXPECT_NEAR(folded.origin.z, 0.5, 1e-6);
    EXPECT_NEAR(folded.size.z, 0.5, 1e-6);
    EXPECT_TRUE(strip({{0, 3, 0}, {1, 3, 0}, {4, 3, 0}}, even).bent) << "uneven";
}
