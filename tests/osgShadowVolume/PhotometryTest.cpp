// SPDX-License-Identifier: MIT
#include "MeasuredScenes.h"

#include <osgShadowVolume/Photometry.h>

#include <osg/MatrixTransform>
#include <osg/ValueObject>

#include <gtest/gtest.h>

#include <cmath>

using namespace osgShadowVolume;

namespace
{

constexpr double Pi = 3.14159265358979323846;

osg::ref_ptr<osg::LightSource> lamp(const std::string& description = "")
{
    osg::ref_ptr<osg::Group> scope = new osg::Group;
    return measured::pointLight(1, osg::Vec3(), description, *scope);
}

std::string errorOf(const std::string& description)
{
    const Stated stated = intensityOf(*lamp(description));
    EXPECT_FALSE(stated.isKnown());
    return stated.error;
}

} // namespace

TEST(PhotometryTest, candelaIsFoundInEachPlace)
{
    EXPECT_EQ(intensityOf(*lamp("candela=1200")).value, 1200.0);
    EXPECT_EQ(intensityOf(*lamp("made by x, candela = 1.2e3; new")).value, 1200.0);
    osg::ref_ptr<osg::LightSource> source = lamp();
    source->getLight()->setName("lamp_candela=7");
    EXPECT_EQ(intensityOf(*source).value, 7.0);
    source->setName("candela=8");
    EXPECT_EQ(intensityOf(*source).value, 8.0);
    source->getLight()->getOrCreateUserDataContainer()->addDescription("candela=9");
    EXPECT_EQ(intensityOf(*source).value, 9.0);
    source->addDescription("candela=10");
    EXPECT_EQ(intensityOf(*source).value, 10.0);
    source->getLight()->setUserValue("candela", std::string("11.5"));
    EXPECT_EQ(intensityOf(*source).value, 11.5);
    source->setUserValue("candela", 12);
    EXPECT_EQ(intensityOf(*source).value, 12.0);
}

TEST(PhotometryTest, lumenAreSpreadOverTheSphereOrTheCone)
{
    EXPECT_NEAR(intensityOf(*lamp("lumen=800")).value, 800.0 / (4.0 * Pi), 1e-9);
    const osg::ref_ptr<osg::LightSource> spot = lamp("lumen=100");
    spot->getLight()->setSpotCutoff(60.0f);
    EXPECT_NEAR(intensityOf(*spot).value, 100.0 / Pi, 1e-9); // half of the half space's 2 pi
    spot->getLight()->setSpotCutoff(90.0f);
    spot->getLight()->setSpotExponent(1.0f);
    EXPECT_NEAR(intensityOf(*spot).value, 100.0 / Pi, 1e-9); // a Lambertian surface
}

TEST(PhotometryTest, coneIsTheIntegralOfItsFallOff)
{
    for (double cutoff : {0.01, 5.0, 45.0, 90.0})
        for (double exponent : {0.0, 0.5, 4.0, 128.0})
        {
            // The midpoint rule with 1e5 steps is right to 1e-9 for these smooth integrands; near
            // 90 degrees cos^0.5 has a vertical tangent and it is right to 1e-7.
            double sum = 0.0;
            const double step = cutoff * Pi / 180.0 / 100000.0;
            for (int i = 0; i < 100000; ++i)
            {
                const double angle = (i + 0.5) * step;
                sum += 2.0 * Pi * std::sin(angle) * std::pow(std::cos(angle), exponent) * step;
            }
            EXPECT_NEAR(coneOf(cutoff, exponent) / sum, 1.0, 1e-6) << cutoff << " " << exponent;
        }
}

TEST(PhotometryTest, wrongStatementsAreNamed)
{
    EXPECT_EQ(errorOf(""), "it states no candela=<number>");
    EXPECT_EQ(errorOf("candelabra"), "it states no candela=<number>");
    EXPECT_EQ(errorOf("candela=-5"), "its candela=-5 is not a number of at least 0");
    EXPECT_EQ(errorOf("candela=bright"), "its candela=bright is not a number of at least 0");
    EXPECT_EQ(errorOf("candela=nan"), "its candela=nan is not a number of at least 0");
    EXPECT_EQ(errorOf("candela="), "its candela= is not a number of at least 0");
    EXPECT_EQ(errorOf("candela=5 lumen=60"), "it states both candela and lumen");
    EXPECT_EQ(errorOf("lux=5"),
              "it has a position and needs candela=<number> or lumen=<number> instead of lux");
    osg::ref_ptr<osg::Group> scope = new osg::Group;
    EXPECT_EQ(intensityOf(*measured::sun(1, osg::Vec3(0, 0, 1), "candela=5", *scope)).error,
              "it is directional and needs lux=<number> instead of candela or lumen");
    const osg::ref_ptr<osg::LightSource> spot = lamp("lumen=100");
    spot->getLight()->setSpotCutoff(0.0f);
    EXPECT_EQ(intensityOf(*spot).error, "its cone is empty, so its lumen give no candela");
}

TEST(PhotometryTest, scaleIsFoundAtBelowAndAboveANode)
{
    osg::ref_ptr<osg::Group> root = new osg::Group, scene = new osg::Group, model = new osg::Group;
    root->addChild(scene);
    scene->addChild(new osg::Group);
    scene->addChild(model);
    EXPECT_EQ(metresPerUnitOf(*scene).error, "no node states metresPerUnit=<number>");
    root->setName("root_metresPerUnit=2.5");
    EXPECT_EQ(metresPerUnitOf(*scene).value, 2.5);
    root->setUserValue("metresPerUnit", 3.0);
    EXPECT_EQ(metresPerUnitOf(*scene).value, 3.0);
    model->addDescription("metresPerUnit=0.001");
    EXPECT_EQ(metresPerUnitOf(*scene).value, 0.001);
    scene->getChild(0)->setUserValue("metresPerUnit", 0.0254f);
    EXPECT_EQ(metresPerUnitOf(*scene).error,
              "nodes contradict each other: metresPerUnit=0.0254 and 0.001");
    scene->setUserValue("metresPerUnit", 2);
    EXPECT_EQ(metresPerUnitOf(*scene).value, 2.0);
    scene->setUserValue("metresPerUnit", 0);
    EXPECT_EQ(metresPerUnitOf(*scene).error,
              "a node's statement is wrong: its metresPerUnit=0 is not a number of at least 1e-12");
}
