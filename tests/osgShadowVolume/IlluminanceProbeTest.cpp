// SPDX-License-Identifier: MIT
#include "MeasuredScenes.h"

#include <osgShadowVolume/IlluminanceProbe.h>
#include <osgShadowVolume/Photometry.h>

#include <support/NotifyCapture.h>

#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Switch>
#include <osg/ValueObject>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace osgShadowVolume;

namespace
{

constexpr double Pi = 3.14159265358979323846;
/// Positions of lights and vertices are floats: 1e-7 of a length, twice that of its square.
constexpr double FloatShare = 1e-6;

ShadowSettings metres(double perUnit)
{
    ShadowSettings settings;
    settings.metresPerUnit = perUnit;
    return settings;
}

IlluminanceProbe probeOf(osg::Group& scene)
{
    return IlluminanceProbe(scene, metres(1.0));
}

osg::ref_ptr<osg::Group> floorOf(float side)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(measured::quad(osg::Vec3(-side, -side, 0.0f), osg::Vec3(2 * side, 0, 0),
                                   osg::Vec3(0, 2 * side, 0)));
    return scene;
}

} // namespace

TEST(IlluminanceProbeTest, pointLightKeepsInverseSquareAndCosine)
{
    osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::pointLight(1, osg::Vec3(1.0f, 2.0f, 3.0f), "candela=900", *scene));
    const IlluminanceProbe probe = probeOf(*scene);
    ASSERT_EQ(probe.getError(), "");
    EXPECT_NEAR(probe.measure(osg::Vec3d(1.0, 2.0, 0.0)).lux, 100.0, 100.0 * FloatShare);
    for (double x : {-9.0, -2.5, 0.0, 4.0, 9.5})
    {
        const double d = std::hypot(x - 1.0, 2.0, 3.0);
        const double expected = 900.0 * 3.0 / (d * d * d);
        EXPECT_NEAR(probe.measure(osg::Vec3d(x, 0.0, 0.0)).lux, expected, expected * FloatShare);
    }
    EXPECT_EQ(probe.measure(osg::Vec3d(1, 2, 0), osg::Vec3d(0, 0, -1)).lux, 0.0);
    EXPECT_NEAR(probe.measure(osg::Vec3d(1, 2, 1), osg::Vec3d(0, 5, 5)).lux, 225.0 * std::sqrt(0.5),
                225.0 * FloatShare);
}

TEST(IlluminanceProbeTest, spotFallsOffWithItsExponentAndEndsAtItsCutoff)
{
    osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    osg::ref_ptr<osg::LightSource> spot =
        measured::spotLight(9, osg::Vec3(0.0f, 0.0f, 2.0f), 30.0f, 4.0f, "candela=400", *scene);
    spot->getLight()->setQuadraticAttenuation(5.0f); // plays no part
    scene->addChild(spot);
    const IlluminanceProbe probe = probeOf(*scene);
    for (double degrees : {0.0, 10.0, 20.0, 29.9})
    {
        const double c = std::cos(degrees * Pi / 180.0), d = 2.0 / c;
        const double expected = 400.0 * std::pow(c, 4.0) * c / (d * d);
        EXPECT_NEAR(probe.measure(osg::Vec3d(0.0, 2.0 * std::tan(degrees * Pi / 180.0), 0.0)).lux,
                    expected, expected * FloatShare);
    }
    EXPECT_EQ(probe.measure(osg::Vec3d(2.0 * std::tan(30.1 * Pi / 180.0), 0.0, 0.0)).lux, 0.0);
}

TEST(IlluminanceProbeTest, directionalLightIsItsLuxTimesTheCosine)
{
    osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::sun(0, osg::Vec3(0.0f, 3.0f, 4.0f), "lux=100000", *scene));
    scene->addChild(measured::box(osg::Vec3(-1, 1, 1), osg::Vec3(1, 2, 2)));
    const IlluminanceProbe probe = probeOf(*scene);
    EXPECT_NEAR(probe.measure(osg::Vec3d(8.0, 8.0, 0.0)).lux, 80000.0, 80000.0 * FloatShare);
    // The box from 1 to 2 m high throws its shadow 3/4 of its height towards -y.
    EXPECT_EQ(probe.measure(osg::Vec3d(0.0, 1.0, 0.0)).lux, 0.0);
    EXPECT_EQ(probe.measure(osg::Vec3d(0.0, -0.49, 0.0)).lux, 0.0);
    EXPECT_GT(probe.measure(osg::Vec3d(0.0, -0.51, 0.0)).lux, 0.0);
    EXPECT_GT(probe.measure(osg::Vec3d(1.01, 0.5, 0.0)).lux, 0.0);
}

TEST(IlluminanceProbeTest, deskOfAClosedRoomShadowsTheFloorAndNotItself)
{
    for (double scale : {1.0, 1e-3})
    {
        const osg::ref_ptr<osg::Group> room = measured::classRoom(scale);
        const IlluminanceProbe probe(*room, ShadowSettings());
        ASSERT_EQ(probe.getError(), "");
        const double m = 1.0 / scale;
        const double desk = 1000.0 / (1.75 * 1.75);
        EXPECT_NEAR(probe.measure(osg::Vec3d(4.0, 3.0, 0.75) * m).lux, desk, desk * FloatShare);
        EXPECT_EQ(probe.measure(osg::Vec3d(4.0, 3.0, 0.0) * m).lux, 0.0);
        // The edge at x = 4.8 m, 1.75 m below the lamp, throws its shadow to 4 + 0.8 * 2.5 / 1.75.
        // The edge of the underside reaches less far.
        const double edge = 4.0 + 0.8 * 2.5 / 1.75;
        EXPECT_EQ(probe.measure(osg::Vec3d(edge - 0.001, 3.0, 0.0) * m).lux, 0.0);
        const double d2 = std::pow(edge + 0.001 - 4.0, 2) + 2.5 * 2.5;
        const double floor = 1000.0 * 2.5 / (d2 * std::sqrt(d2));
        EXPECT_NEAR(probe.measure(osg::Vec3d(edge + 0.001, 3.0, 0.0) * m).lux, floor,
                    floor * FloatShare);
        // A wall: the light comes from the side.
        const double wall = 1000.0 / 16.0;
        EXPECT_NEAR(probe.measure(osg::Vec3d(0.0, 3.0, 2.5) * m, osg::Vec3d(1, 0, 0)).lux, wall,
                    wall * FloatShare);
        // Outside, behind the walls.
        EXPECT_EQ(probe.measure(osg::Vec3d(-1.0, 3.0, 2.5) * m, osg::Vec3d(1, 0, 0)).lux, 0.0);
    }
}

TEST(IlluminanceProbeTest, lampInTheCeilingLightsTheRoom)
{
    const osg::ref_ptr<osg::Group> room = measured::classRoom();
    room->addChild(measured::pointLight(2, osg::Vec3(1.0f, 1.0f, 3.0f), "candela=900", *room));
    const IlluminanceProbe::Reading reading =
        IlluminanceProbe(*room, ShadowSettings()).measure(osg::Vec3d(1.0, 1.0, 0.0));
    ASSERT_EQ(reading.luxOfLight.size(), 2u);
    EXPECT_NEAR(reading.luxOfLight[1], 100.0, 100.0 * FloatShare);
}

TEST(IlluminanceProbeTest, hundredLightsAddUp)
{
    osg::ref_ptr<osg::Group> scene = floorOf(20.0f);
    double expected = 0.0;
    for (int i = 0; i < 100; ++i)
    {
        const float x = float(i % 10) - 4.5f, y = float(i / 10) - 4.5f;
        scene->addChild(measured::pointLight(i, osg::Vec3(x, y, 3.0f),
                                             "candela=" + std::to_string(10 + i), *scene));
        const double d = std::hypot(double(x), double(y), 3.0);
        expected += (10 + i) * 3.0 / (d * d * d);
    }
    EXPECT_NEAR(probeOf(*scene).measure(osg::Vec3d()).lux, expected, expected * FloatShare);
}

TEST(IlluminanceProbeTest, transformsAndSwitchesOfLightsCount)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
        osg::Matrixd::scale(2.0, 2.0, 2.0) * osg::Matrixd::rotate(Pi, osg::X_AXIS) *
        osg::Matrixd::translate(1e7, 0.0, 5.0));
    transform->addChild(
        measured::spotLight(1, osg::Vec3(0, 0, -1), 20.0f, 0.0f, "candela=100", *scene));
    scene->addChild(transform);
    osg::ref_ptr<osg::Switch> off = new osg::Switch;
    off->addChild(measured::pointLight(2, osg::Vec3(), "", *scene), false);
    scene->addChild(off);
    // The lamp is at a height of 7 units of 0.5 m and looks up now.
    const IlluminanceProbe probe(*scene, metres(0.5));
    ASSERT_EQ(probe.getError(), "");
    EXPECT_EQ(probe.measure(osg::Vec3d(1e7, 0.0, 1.0)).lux, 0.0);
    EXPECT_NEAR(probe.measure(osg::Vec3d(1e7, 0.0, 9.0), osg::Vec3d(0, 0, -1)).lux, 100.0,
                100.0 * FloatShare);
}

TEST(IlluminanceProbeTest, workPlaneHasMinimumMeanMaximumAndUniformity)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(measured::pointLight(1, osg::Vec3(0, 0, 2), "candela=400", *scene));
    WorkPlane plane;
    plane.corner = osg::Vec3d(-2.0, -1.0, 0.0);
    plane.u = osg::Vec3d(0.0, 2.0, 0.0); // u x v points down: the plane faces up all the same
    plane.v = osg::Vec3d(4.0, 0.0, 0.0);
    plane.columns = 2;
    plane.rows = 4;
    const IlluminanceProbe::PlaneReading reading = probeOf(*scene).measure(plane);
    ASSERT_EQ(reading.points.size(), 8u);
    EXPECT_EQ(reading.points.front(), osg::Vec3d(-1.5, -0.5, 0.0));
    EXPECT_EQ(reading.points.back(), osg::Vec3d(1.5, 0.5, 0.0));
    const auto at = [](double x) { return 800.0 / std::pow(x * x + 0.25 + 4.0, 1.5); };
    EXPECT_NEAR(reading.minimum, at(1.5), 1e-3);
    EXPECT_NEAR(reading.maximum, at(0.5), 1e-3);
    EXPECT_NEAR(reading.mean, 0.5 * (at(0.5) + at(1.5)), 1e-3);
    EXPECT_NEAR(reading.uniformity, at(1.5) / (0.5 * (at(0.5) + at(1.5))), 1e-6);
}

TEST(IlluminanceProbeTest, gridSpacingIsThatOfTheStandard)
{
    unsigned int columns = 0, rows = 0;
    fillStandardCells(1.0, 1.0, columns, rows); // p = 0.2 m
    EXPECT_EQ(columns, 5u);
    EXPECT_EQ(rows, 5u);
    fillStandardCells(10.0, 8.0, columns, rows); // p = 1 m
    EXPECT_EQ(columns, 10u);
    EXPECT_EQ(rows, 8u);
    fillStandardCells(5.0, 10.0, columns, rows); // the shorter side counts, p = 0.616 m
    EXPECT_EQ(columns, 8u);
    EXPECT_EQ(rows, 16u);
    fillStandardCells(10000.0, 10000.0, columns, rows); // p = 10 m
    EXPECT_EQ(columns, 1000u);
}

TEST(IlluminanceProbeTest, withoutShadowsNothingCasts)
{
    const osg::ref_ptr<osg::Group> room = measured::classRoom();
    ShadowSettings settings;
    settings.shadows = Shadows::OFF;
    EXPECT_NEAR(IlluminanceProbe(*room, settings).measure(osg::Vec3d(4.0, 3.0, 0.0)).lux, 160.0,
                160.0 * FloatShare);
}

TEST(IlluminanceProbeTest, trianglesWithIndicesBeyondTheVerticesCastNothingAndWarnOnce)
{
    osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(
        osg::Vec3(0, -1, 1), osg::Vec3(1, 0, 0), osg::Vec3(0, 2, 0));
    geometry->setName("torn");
    // What OSG itself makes of such indices is its own affair.
    geometry->setInitialBound(osg::BoundingBox(0, -1, 1, 1, 1, 1));
    geometry->setComputeBoundingBoxCallback(new osg::Drawable::ComputeBoundingBoxCallback);
    geometry->removePrimitiveSet(0);
    osg::ref_ptr<osg::DrawElementsUInt> elements = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (const unsigned int i : {0u, 1u, 2u, 0u, 2u, 3u, 0u, 1u, 4000000000u})
        elements->push_back(i);
    geometry->addPrimitiveSet(elements);
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(geometry);
    scene->addChild(measured::pointLight(1, osg::Vec3(0, 0, 2), "candela=400", *scene));
    support::NotifyCapture capture;
    for (int i = 0; i < 2; ++i)
    {
        const IlluminanceProbe probe = probeOf(*scene);
        EXPECT_EQ(probe.getNumTriangles(), 2u);
        EXPECT_EQ(probe.measure(osg::Vec3d(0.5, 0.0, 0.0)).lux, 0.0);
        EXPECT_GT(probe.measure(osg::Vec3d(-0.5, 0.0, 0.0)).lux, 0.0);
    }
    EXPECT_EQ(
        capture.takeWarnings(),
        support::NotifyCapture::Lines{
            "osgShadowVolume: drawable 'torn': 1 of its triangles casts no shadow, because an "
            "index is beyond the vertices"});
}

TEST(IlluminanceProbeTest, whatIsUnknownIsNamed)
{
    osg::ref_ptr<osg::Group> scene = floorOf(1.0f);
    EXPECT_EQ(IlluminanceProbe(*scene, ShadowSettings()).getError(),
              "no illuminance without a scale: no node states metresPerUnit=<number>");
    EXPECT_EQ(probeOf(*scene).getError(),
              "no illuminance without lights: the scene has no LightSource");
    osg::ref_ptr<osg::LightSource> lamp = measured::pointLight(3, osg::Vec3(0, 0, 1), "", *scene);
    lamp->getLight()->setName("lamp");
    scene->addChild(lamp);
    EXPECT_EQ(probeOf(*scene).getError(), "no illuminance without intensities: light 3 'lamp': it "
                                          "states no candela=<number>");
    ShadowSettings settings = metres(1.0);
    settings.candela = 7.0;
    EXPECT_NEAR(IlluminanceProbe(*scene, settings).measure(osg::Vec3d()).lux, 7.0, 1e-5);
    lamp->setUserValue("candela", -1);
    EXPECT_EQ(IlluminanceProbe(*scene, settings).getError(),
              "no illuminance without intensities: light 3 'lamp': its candela=-1 is not a number "
              "of at least 0");
    lamp->setUserValue("candela", 5);
    EXPECT_EQ(probeOf(*scene).getError(), "");
}

TEST(IlluminanceProbeTest, trianglesOfATreeBlockAsEachAloneDoes)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> inBox(-1.0, 1.0);
    const auto point = [&] { return glm::dvec3(inBox(random), inBox(random), inBox(random)); };
    std::vector<TriangleTree::Triangle> triangles;
    for (int i = 0; i < 200; ++i)
    {
        const glm::dvec3 a = point();
        triangles.push_back({a, a + 0.2 * point(), a + 0.2 * point()});
    }
    const TriangleTree tree(triangles);
    int blocked = 0;
    for (int ray = 0; ray < 2000; ++ray)
    {
        const glm::dvec3 from = point(), direction = point();
        bool any = false;
        for (const TriangleTree::Triangle& triangle : triangles)
            any = any || TriangleTree({triangle}).blocks(from, direction, 0.0);
        EXPECT_EQ(tree.blocks(from, direction, 0.0), any);
        blocked += any;
    }
    EXPECT_GT(blocked, 200);
    EXPECT_LT(blocked, 1800);
}

TEST(IlluminanceProbeTest, neighbouringTrianglesLeaveNoGap)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> inBox(-1.0, 1.0);
    for (int i = 0; i < 100000; ++i)
    {
        // Rays at the common diagonal of a quad.
        const glm::dvec3 a(-1.3, -1.1, inBox(random)), b(1.1, -1.2, inBox(random)),
            c(1.4, 1.2, inBox(random)), d(-1.2, 1.3, inBox(random));
        const TriangleTree tree({{a, b, c}, {a, c, d}});
        const glm::dvec3 target = a + (0.5 + 0.5 * inBox(random)) * 0.999 * (c - a);
        const glm::dvec3 from(0.3 * inBox(random), 0.3 * inBox(random), 5.0);
        ASSERT_TRUE(tree.blocks(from, 2.0 * (target - from), 0.0)) << i;
    }
}
