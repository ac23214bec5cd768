// SPDX-License-Identifier: MIT
#include <osgLabels/MeshSides.h>

#include <osg/Geometry>
#include <osg/Shape>
#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

using osgLabels::MeshSides;
using osgLabels::sidesOf;

namespace
{

MeshSides sidesOfShape(osg::Shape* shape)
{
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    return sidesOf(*drawable);
}

/// A tetrahedron; the given number of its triangles, with the i-th of them turned.
osg::ref_ptr<osg::Geometry> tetrahedron(unsigned int triangles, int turned = -1)
{
    const osg::Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const GLushort faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(4, corners));
    osg::ref_ptr<osg::DrawElementsUShort> indices = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (unsigned int i = 0; i < triangles; ++i)
        for (int j = 0; j < 3; ++j)
            indices->push_back(faces[i][int(i) == turned ? 2 - j : j]);
    geometry->addPrimitiveSet(indices);
    return geometry;
}

void turnAll(osg::Geometry& geometry)
{
    auto& indices = static_cast<osg::DrawElementsUShort&>(*geometry.getPrimitiveSet(0));
    for (std::size_t i = 0; i < indices.size(); i += 3)
        std::swap(indices[i], indices[i + 1]);
}

} // namespace

TEST(MeshSides, closedMeshesHaveAnOutside)
{
    EXPECT_EQ(sidesOf(*tetrahedron(4)), MeshSides::Outward);
    const auto inward = tetrahedron(4);
    turnAll(*inward);
    EXPECT_EQ(sidesOf(*inward), MeshSides::Inward);
}

TEST(MeshSides, aMissingOrTurnedTriangleOpensTheMesh)
{
    EXPECT_EQ(sidesOf(*tetrahedron(3)), MeshSides::Open);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(sidesOf(*tetrahedron(4, i)), MeshSides::Open) << i;
    EXPECT_EQ(sidesOf(*tetrahedron(0)), MeshSides::Open);
}

TEST(MeshSides, shapesOfOsgAreClosedAtTheirSeams)
{
    const osg::Vec3 at(103.7f, -20.3f, 7.1f);
    EXPECT_EQ(sidesOfShape(new osg::Box(at, 1, 2, 3)), MeshSides::Outward);
    EXPECT_EQ(sidesOfShape(new osg::Sphere(at, 1.3f)), MeshSides::Outward);
    EXPECT_EQ(sidesOfShape(new osg::Cylinder(at, 0.7f, 2)), MeshSides::Outward);
    EXPECT_EQ(sidesOfShape(new osg::Cone(at, 0.7f, 2)), MeshSides::Outward);
    EXPECT_EQ(sidesOfShape(new osg::Capsule(at, 0.7f, 2)), MeshSides::Outward);
}

TEST(MeshSides, whatIsNoNumberOrHasNoFacesIsOpen)
{
    const auto broken = tetrahedron(4);
    (*static_cast<osg::Vec3Array*>(broken->getVertexArray()))[2].x() =
        std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(sidesOf(*broken), MeshSides::Open);
    const auto points = tetrahedron(4);
    points->getPrimitiveSet(0)->setMode(GL_POINTS);
    EXPECT_EQ(sidesOf(*points), MeshSides::Open);
}
