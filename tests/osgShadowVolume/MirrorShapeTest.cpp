// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MirrorNames.h>
#include <osgShadowVolume/MirrorShape.h>

#include <osg/Group>
#include <osg/Material>
#include <osg/ValueObject>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace osgShadowVolume;

namespace
{

/// Two triangles from -1 to 1 at a depth, counter-clockwise towards the viewer.
std::vector<glm::dvec3> square(double z, double x = 0.0)
{
    const glm::dvec3 a(x - 1, -1, z), b(x + 1, -1, z), c(x + 1, 1, z), d(x - 1, 1, z);
    return {a, b, c, a, c, d};
}

MirrorShape shapeOf(const std::vector<glm::dvec3>& triangles)
{
    std::string error;
    const auto shape = fitMirror(triangles, error);
    EXPECT_TRUE(shape) << error;
    return shape.value_or(MirrorShape());
}

const glm::dmat4 perspective = glm::perspective(glm::radians(90.0), 1.0, 1.0, 100.0);
const glm::dmat4 parallel = glm::ortho(-4.0, 4.0, -4.0, 4.0, 1.0, 100.0);

TEST(MirrorShapeTest, flatTrianglesHaveARectangle)
{
    const MirrorShape shape = shapeOf(square(-3.0));
    for (const glm::dvec3& corner : shape.corners)
    {
        EXPECT_NEAR(std::abs(corner.x), 1.0, 1e-12);
        EXPECT_NEAR(std::abs(corner.y), 1.0, 1e-12);
        EXPECT_NEAR(corner.z, -3.0, 1e-12);
    }
}

TEST(MirrorShapeTest, bentEmptyAndInfiniteTrianglesHaveNone)
{
    std::string error;
    std::vector<glm::dvec3> bent = square(-3.0);
    bent.back().z += 0.01;
    EXPECT_FALSE(fitMirror(bent, error));
    EXPECT_EQ(error, "not planar");
    bent.back().z = -3.0 + 1e-5; // less than 1e-4 of the size
    EXPECT_TRUE(fitMirror(bent, error));
    EXPECT_FALSE(fitMirror({}, error));
    EXPECT_EQ(error, "without area");
    EXPECT_FALSE(fitMirror({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, error));
    EXPECT_EQ(error, "without area");
    bent.back().z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(fitMirror(bent, error));
    bent.back().z = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(fitMirror(bent, error));
}

TEST(MirrorShapeTest, theEyeIsAPointOrADirection)
{
    EXPECT_LT(glm::distance(eyeOf(perspective), glm::dvec4(0, 0, 0, 1)), 1e-12);
    EXPECT_LT(glm::distance(eyeOf(parallel), glm::dvec4(0, 0, 1, 0)), 1e-12);
    const glm::dmat4 offAxis = glm::frustum(0.5, 1.5, -1.0, 2.0, 1.0, 50.0);
    const glm::dmat4 moved = offAxis * glm::translate(glm::dmat4(1.0), glm::dvec3(-3, 2, 1));
    EXPECT_LT(glm::distance(eyeOf(moved), glm::dvec4(3, -2, -1, 1)), 1e-12);
}

TEST(MirrorShapeTest, planesFaceTheEye)
{
    const MirrorShape before = shapeOf(square(-3.0));
    const auto plane = planeTowards(before, eyeOf(perspective));
    ASSERT_TRUE(plane);
    EXPECT_LT(glm::distance(*plane, glm::dvec4(0, 0, 1, 3)), 1e-12);
    EXPECT_TRUE(showsFront(before, *plane));
    std::vector<glm::dvec3> turned = square(-3.0);
    std::reverse(turned.begin(), turned.end());
    EXPECT_FALSE(showsFront(shapeOf(turned), *plane));
    // Through the eye, and along a parallel view.
    const glm::dmat4 upright =
        glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(0, 1, 0));
    EXPECT_FALSE(
        planeTowards(before.transformed(upright * glm::translate(glm::dmat4(1.0), {0, 0, 3})),
                     eyeOf(perspective)));
    EXPECT_FALSE(planeTowards(before.transformed(upright), eyeOf(parallel)));
}

TEST(MirrorShapeTest, reflectionKeepsThePlaneAndExchangesItsSides)
{
    const glm::dvec4 plane(glm::normalize(glm::dvec3(1, 2, -2)), -0.7);
    const glm::dmat4 m = reflectionIn(plane);
    EXPECT_NEAR(glm::determinant(m), -1.0, 1e-12);
    const glm::dvec4 p(3, -1, 4, 1), q = m * p;
    EXPECT_NEAR(glm::dot(plane, p), -glm::dot(plane, q), 1e-12);
    EXPECT_LT(glm::distance(m * q, p), 1e-12);
}

TEST(MirrorShapeTest, theShareOfTheViewIsWhatIsSeen)
{
    // At a depth of 2 the view is 4 wide and high.
    EXPECT_NEAR(shareOfView(shapeOf(square(-2.0)), perspective), 4.0 / 16.0, 1e-12);
    EXPECT_NEAR(shareOfView(shapeOf(square(-2.0, 2.0)), perspective), 2.0 / 16.0, 1e-12);
    EXPECT_EQ(shareOfView(shapeOf(square(-2.0, 5.0)), perspective), 0.0);
    EXPECT_EQ(shareOfView(shapeOf(square(2.0)), perspective), 0.0);
    EXPECT_TRUE(isBehind(shapeOf(square(2.0)), perspective));
    EXPECT_FALSE(isBehind(shapeOf(square(-2.0, 5.0)), perspective));
    EXPECT_NEAR(shareOfView(shapeOf(square(-2.0)), parallel), 4.0 / 64.0, 1e-12);
    // A floor from behind the viewer to far away.
    MirrorShape floor;
    floor.corners = {glm::dvec3{-50, -1, 50}, {50, -1, 50}, {50, -1, -1000}, {-50, -1, -1000}};
    EXPECT_NEAR(shareOfView(floor, perspective), 0.5, 0.01);
}

TEST(MirrorNamesTest, namesSayHowMuchTheyReflect)
{
    for (const char* name :
         {"mirror", "Mirror", "mirror_hall", "mirror2", "mirror 12 a", "mirror."})
        EXPECT_EQ(reflectivityOfName(name), DefaultReflectivity) << name;
    EXPECT_EQ(reflectivityOfName("Mirror0.3"), 0.3);
    EXPECT_EQ(reflectivityOfName("MIRROR0.25_left"), 0.25);
    EXPECT_EQ(reflectivityOfName("mirror=1"), 1.0);
    EXPECT_EQ(reflectivityOfName("mirror=0"), 0.0);
    EXPECT_EQ(reflectivityOfName("mirror30"), 0.3);
    EXPECT_EQ(reflectivityOfName("mirror05_floor"), 0.05);
    EXPECT_EQ(reflectivityOfName("mirror100"), 1.0);
    for (const char* name :
         {"", "mirro", "mirrored", "a mirror", "mirror1.5", "mirror999", "mirror=x", "mirror0.3.4"})
        EXPECT_FALSE(reflectivityOfName(name)) << name;
}

TEST(MirrorNamesTest, theFirstOfANodesMarksCounts)
{
    osg::ref_ptr<osg::Group> node = new osg::Group;
    EXPECT_FALSE(mirrorMarkOf(*node));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setName("mirror10");
    node->getOrCreateStateSet()->setAttribute(material);
    ASSERT_TRUE(mirrorMarkOf(*node));
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.1);
    EXPECT_TRUE(mirrorMarkOf(*node)->byMaterial);
    node->setName("mirror20");
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.2);
    EXPECT_FALSE(mirrorMarkOf(*node)->byMaterial);
    node->getStateSet()->setUserValue("mirror", 0.3);
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.3);
    node->addDescription("mirror=0.4");
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.4);
    node->setUserValue("mirror", std::string("0.5"));
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.5);
    node->setUserValue("mirror", true);
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, DefaultReflectivity);
    node->setUserValue("mirror", 0);
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.0);
    node->setUserValue("mirror", 7.0); // says nothing
    EXPECT_EQ(mirrorMarkOf(*node)->reflectivity, 0.4);
}

} // namespace
