// SPDX-License-Identifier: MIT
#include "RenderProcess.h"
#include "RenderScenes.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/ValueObject>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace
{

/// A floor of 10 x 10 m, a shade of 2 x 2 m at a height of 1 m around the origin, and lamp 5 of
/// 400 cd 2 m above the floor, described by `description`.
osg::ref_ptr<osg::Group> lampOverShade(const std::string& description)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    const auto add = [&](float half, float z)
    {
        osg::ref_ptr<osg::Geode> geode = new osg::Geode; // .ive knows Drawables in these only
        geode->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(-half, -half, z),
                                                           osg::Vec3(2.0f * half, 0.0f, 0.0f),
                                                           osg::Vec3(0.0f, 2.0f * half, 0.0f)));
        scene->addChild(geode);
    };
    add(5.0f, 0.0f);
    add(1.0f, 1.0f);
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(5);
    source->getLight()->setName("lamp");
    source->getLight()->setPosition(osg::Vec4(0.0f, 0.0f, 2.0f, 1.0f));
    if (!description.empty())
        source->addDescription(description);
    source->setStateSetModes(*scene->getOrCreateStateSet(), osg::StateAttribute::ON);
    scene->addChild(source);
    return scene;
}

} // namespace

class OsgRenderProbeGLTest : public RenderProcess
{
protected:
    void SetUp() override
    {
        const osg::ref_ptr<osg::Group> scene = lampOverShade("candela=400");
        scenes::write(*scene, _folder.file("unscaled.osgt"));
        scene->setUserValue("metresPerUnit", 1.0);
        scenes::write(*scene, _folder.file("lamp.osgt"));
        scenes::write(*scene, _folder.file("lamp.ive"));
        scenes::write(*lampOverShade(""), _folder.file("dark.osgt"));
    }
};

TEST_F(OsgRenderProbeGLTest, pointsArePrintedWithEachLightsShare)
{
    const support::ProcessResult result =
        run({"lamp.osgt", "--probe", "0,0,1", "--probe", "0,0,0", "--probe", "3,0,0,0,0,2"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.errors, "");
    // 400 * 2 / 13^1.5
    EXPECT_EQ(result.output, "probe 0,0,1 normal 0,0,1: 400 lux = 400 (light 5 'lamp')\n"
                             "probe 0,0,0 normal 0,0,1: 0 lux = 0 (light 5 'lamp')\n"
                             "probe 3,0,0 normal 0,0,2: 17.0677 lux = 17.0677 (light 5 'lamp')\n");
}

TEST_F(OsgRenderProbeGLTest, descriptionsOutliveOsgsBinaryFormat)
{
    // .ive keeps descriptions, not user values.
    const support::ProcessResult result =
        run({"lamp.ive", "--probe", "0,0,1", "--metres-per-unit", "2"});
    EXPECT_EQ(result.errors, "");
    EXPECT_EQ(result.output, "probe 0,0,1 normal 0,0,1: 100 lux = 100 (light 5 'lamp')\n");
}

TEST_F(OsgRenderProbeGLTest, gridsHaveMinimumMeanMaximumAndUniformity)
{
    const support::ProcessResult result =
        run({"lamp.osgt", "--probe-grid", "corner:1,-1,1;u:2,0,0;v:0,2,0;n:2x1", "--probe-csv",
             "made/grid.csv", "--stats", "stats.json", "--timing", "0", "-o", "lamp.png"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.errors, "");
    const auto lux = [](double x) { return 400.0 / std::pow(x * x + 1.0, 1.5); };
    const double mean = 0.5 * (lux(1.5) + lux(2.5));
    const nlohmann::json grid = nlohmann::json::parse(read("stats.json")).at("probeGrids").at(0);
    EXPECT_NEAR(grid.at("minimum"), lux(2.5), 1e-3);
    EXPECT_NEAR(grid.at("mean"), mean, 1e-3);
    EXPECT_NEAR(grid.at("maximum"), lux(1.5), 1e-3);
    EXPECT_NEAR(grid.at("uniformity"), lux(2.5) / mean, 1e-6);
    EXPECT_EQ(grid.at("columns"), 2);
    EXPECT_EQ(read("made/grid.csv"), "grid,column,row,x,y,z,lux\n"
                                     "0,0,0,1.5,0,1,68.2708\n"
                                     "0,1,0,2.5,0,1,20.4905\n");
    EXPECT_TRUE(exists("lamp.png"));
}

TEST_F(OsgRenderProbeGLTest, unknownQuantitiesFailByName)
{
    expectFails({"unscaled.osgt", "--probe", "0,0,0"}, 1,
                "'unscaled.osgt': no illuminance without a scale: no node states "
                "metresPerUnit=<number>");
    expectFails({"dark.osgt", "--probe", "0,0,0", "--metres-per-unit", "1"}, 1,
                "no illuminance without intensities: light 5 'lamp': it states no "
                "candela=<number>");
}

TEST_F(OsgRenderProbeGLTest, switchesStandInForWhatTheModelDoesNotState)
{
    const support::ProcessResult result =
        run({"dark.osgt", "--probe", "0,0,1", "--metres-per-unit", "1", "--candela", "50"});
    EXPECT_EQ(result.errors, "");
    EXPECT_EQ(result.output, "probe 0,0,1 normal 0,0,1: 50 lux = 50 (light 5 'lamp')\n");
}

TEST_F(OsgRenderProbeGLTest, floatPicturesHoldTheLuxOfTheProbe)
{
    // From straight above, so that the middle of the picture is the shade under the lamp. A float
    // EXR of half a percent.
    expectRenders({"lamp.osgt.(show=lux).shadowvolume", "-o", "lux.exr", "--float", "--camera",
                   "eye:0,0,9;center:0,0,0;up:0,1,0;fov:40"});
    const osg::ref_ptr<osg::Image> lux = picture("lux.exr");
    ASSERT_EQ(lux->s(), 160);
    for (int x = 4; x < 160; ++x)
        for (int y = 4; y < 116; y += 3)
        {
            // Half the picture's height sees tan(20 degrees) of the distance.
            const double across = std::tan(20.0 * 3.14159265358979 / 180.0) / 60.0;
            const double u = (x - 79.5) * across, v = (y - 59.5) * across;
            const bool onShade = std::max(std::abs(u), std::abs(v)) * 8.0 < 0.98;
            const double floor = std::max(std::abs(u), std::abs(v)) * 9.0;
            const double d2 = onShade ? 64.0 * (u * u + v * v) + 1.0 : 81.0 * (u * u + v * v) + 4.0;
            double expected = 400.0 * (onShade ? 1.0 : 2.0) / (d2 * std::sqrt(d2));
            if (!onShade && std::max(std::abs(u), std::abs(v)) * 8.0 < 1.02)
                continue; // the edge of the shade
            if (!onShade && std::abs(floor - 2.0) < 0.08)
                continue; // that of its shadow, from -2 to 2 m
            if (!onShade && floor < 2.0)
                expected = 0.0;
            EXPECT_NEAR(lux->getColor(unsigned(x), unsigned(y)).r(), expected, 0.005 * expected)
                << x << ", " << y;
        }
}

TEST_F(OsgRenderProbeGLTest, legendIsInThePictureOfAWholeModel)
{
    expectRenders({"lamp.osgt.(show=illuminance,maxlux=500).shadowvolume", "-o", "lux.png",
                   "--size", "320x240"});
    // The colour bar at the left: dark below, yellow above.
    const osg::ref_ptr<osg::Image> image = picture("lux.png");
    EXPECT_LT(image->getColor(17u, 50u).g(), 0.4f);
    EXPECT_GT(image->getColor(17u, 182u).g(), 0.7f);
}

TEST_F(OsgRenderProbeGLTest, wrongSwitchesAreNamed)
{
    expectFails({"lamp.osgt", "--probe", "1,2"}, 2, "'1,2' is neither x,y,z nor x,y,z,nx,ny,nz");
    expectFails({"lamp.osgt", "--probe", "1,2,3,0,0,0"}, 2, "the normal has length 0");
    expectFails({"lamp.osgt", "--probe", "1,2,nan"}, 2, "is neither x,y,z");
    expectFails({"lamp.osgt", "--probe-grid", "corner:0,0,0;u:1,0,0"}, 2, "are needed");
    expectFails({"lamp.osgt", "--probe-grid", "corner:0,0,0;u:1,0,0;v:2,0,0"}, 2, "span no area");
    expectFails({"lamp.osgt", "--probe-grid", "corner:0,0,0;u:1,0,0;v:0,1,0;n:0x2"}, 2,
                "n takes COLUMNSxROWS");
    expectFails({"lamp.osgt", "--probe-grid", "corner:0,0,0;u:1,0,0;v:0,1,0;w:1"}, 2,
                "unknown part 'w'");
    expectFails({"lamp.osgt", "-o", "a.png", "--probe-csv", "a.csv"}, 2,
                "--probe-csv goes with --probe-grid");
    expectFails({"lamp.osgt", "--probe", "0,0,0", "--metres-per-unit", "0"}, 2,
                "'0' is not a number above 0");
}
