// SPDX-License-Identifier: MIT
#include "FloorPictures.h"

#include <osg/BlendFunc>
#include <osg/Light>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace floorScene;
using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;

TEST(MapShadows, theErrorFallsWithTheSizeOfTheMaps)
{
    OSGKITS_NEED_GL(viewer());
    for (const char* type : {"directional", "spot", "point"})
    {
        const bool directional = type[0] == 'd';
        osg::ref_ptr<ShadowedScene> scene = shadowed();
        scene->addChild(floorGeode());
        scene->addChild(occluder(1.0));
        // From 8 above, a square at 1 is seen on the floor 8/7 times as large.
        osg::ref_ptr<osg::LightSource> source =
            lightSource(0, directional ? osg::Vec4(0.1f, 0.2f, 1, 0) : osg::Vec4(0.3f, 0.2f, 8, 1));
        if (type[0] == 's')
        {
            source->getLight()->setDirection(osg::Vec3(0, 0, -1));
            source->getLight()->setSpotCutoff(50.0f);
        }
        scene->addChild(source);
        const auto inShadow = [&](const osg::Vec2d& p)
        {
            if (isUnderOccluder(p))
                return false; // the square itself is seen there, lit
            if (directional)
                return isUnderOccluder(p + osg::Vec2d(0.1, 0.2));
            return isUnderOccluder(p + (osg::Vec2d(0.3, 0.2) - p) / 8.0);
        };
        double last = 1.0;
        for (unsigned int size : {64u, 256u, 1024u})
        {
            scene->setMapSize(size);
            const osg::ref_ptr<osg::Image> image = picture(*scene, fromAbove());
            ASSERT_TRUE(image);
            support::writeImage(*image, std::string("map.") + type + "." + std::to_string(size));
            const double wrong = wrongShare(*image, inShadow);
            std::printf("[ error    ] %s, %u texels: %.3f %%\n", type, size, 100.0 * wrong);
            // Four times the texels: a quarter of the error; half leaves room for chance.
            EXPECT_LT(wrong, 0.5 * last) << type << ", " << size;
            last = wrong;
        }
        // The outline is 8 units of 8 * 32 pixels; a pixel's centre may lie on either side.
        EXPECT_LT(last, 0.004) << type;
    }
}

TEST(MapShadows, filteringWidensTheEdgeByItsTexels)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(occluder(1.0));
    scene->addChild(lightSource(0, osg::Vec4(2.2f, 0.3f, 1, 0)));
    scene->setMapSize(128);
    unsigned int between[2] = {};
    double dark[2] = {};
    osg::Vec2d middle[2]; // of the shadow, in pixels
    for (unsigned int samples : {1u, 4u})
    {
        scene->setMapSamples(samples);
        const osg::ref_ptr<osg::Image> image = picture(*scene, fromAbove());
        ASSERT_TRUE(image);
        support::writeImage(*image, "map.pcf" + std::to_string(samples));
        const unsigned int filtered = samples > 1;
        const int full = red(*image, 250, 2);
        for (int y = 0; y < Height; ++y)
            for (int x = 0; x < Width; ++x)
            {
                const int missing = full - red(*image, x, y);
                between[filtered] += missing > 3 && missing < full - 3;
                dark[filtered] += missing;
                middle[filtered] += osg::Vec2d(x, y) * missing;
            }
        middle[filtered] /= dark[filtered];
    }
    EXPECT_EQ(between[0], 0u) << "without a filter there is lit and dark alone";
    // An outline of 8 units, 32 pixels a unit, 4 texels of about 9 / 128 units wide.
    EXPECT_GT(between[1], 1000u);
    EXPECT_LT(between[1], 4000u);
    EXPECT_NEAR(dark[1] / dark[0], 1.0, 0.02) << "it blurs, it does not grow";
    // The shadow's middle lies 2.2 and 0.3 units beside that of the square. A texel is 2 pixels,
    // up to 5 along the light; staircases differ by a little of it.
    const osg::Vec2d expected((4.0 - 2.2) * 32.0 - 0.5, (4.0 - 0.3) * 32.0 - 0.5);
    EXPECT_LT((middle[0] - expected).length(), 0.6);
    EXPECT_LT((middle[1] - expected).length(), 0.6) << "it does not move";
}

TEST(MapShadows, surfacesDoNotShadeThemselves)
{
    OSGKITS_NEED_GL(viewer());
    for (const osg::Vec4& position : {osg::Vec4(3, 1, 0.4f, 0), osg::Vec4(3.5f, 1, 0.5f, 1),
                                      osg::Vec4(0.2f, 0.1f, 1, 0), osg::Vec4(0, 0, 5, 1)})
        for (unsigned int samples : {1u, 2u, 5u})
        {
            osg::ref_ptr<ShadowedScene> scene = shadowed();
            scene->addChild(floorGeode());
            scene->addChild(lightSource(0, position));
            scene->setMapSize(256);
            scene->setMapSamples(samples);
            const osg::ref_ptr<osg::Image> mapped = picture(*scene, fromAbove());
            ASSERT_TRUE(mapped);
            ASSERT_FALSE(scene->getPlans().empty());
            EXPECT_GT(scene->getPlans()[0].counts["shadows.mapLayers"], 0.0) << "no map, no proof";
            scene->setShadows(Shadows::OFF);
            const osg::ref_ptr<osg::Image> plain = picture(*scene, fromAbove());
            EXPECT_EQ(support::difference(*mapped, *plain, 1.0 / 255.0).pixelsOver, 0u)
                << position.x() << ", " << samples;
        }
}

TEST(MapShadows, aPointLightHasNoSeamsBetweenItsFaces)
{
    OSGKITS_NEED_GL(viewer());
    // Inside a closed box: each pixel of the walls is lit. A strip winds around the light so that
    // its shadow crosses edges of the cube of maps.
    for (unsigned int samples : {1u, 4u})
    {
        osg::ref_ptr<ShadowedScene> scene = shadowed();
        const float s = 4.0f;
        scene->addChild(floorGeode());
        scene->addChild(rectangle({-s, s, 0}, {2 * s, 0, 0}, {0, 0, 2 * s}));
        scene->addChild(rectangle({-s, -s, 0}, {0, 2 * s, 0}, {0, 0, 2 * s}));
        scene->addChild(rectangle({s, s, 0}, {0, -2 * s, 0}, {0, 0, 2 * s}));
        scene->addChild(lightSource(0, osg::Vec4(0.1f, 0.3f, 2.5f, 1)));
        scene->setMapSize(128);
        scene->setMapSamples(samples);
        const support::CameraSpec camera = support::CameraSpec::perspective(
            {0, -11, 4}, {0, 0, 3}, {0, 0, 1}, 50.0, 1.0, 1.0, 40.0);
        const osg::ref_ptr<osg::Image> mapped = picture(*scene, camera);
        ASSERT_TRUE(mapped);
        support::writeImage(*mapped, "map.faces" + std::to_string(samples));
        EXPECT_EQ(scene->getPlans().at(0).counts["shadows.mapLayers"], 6.0);
        scene->setShadows(Shadows::OFF);
        const osg::ref_ptr<osg::Image> plain = picture(*scene, camera);
        EXPECT_EQ(support::difference(*mapped, *plain, 1.0 / 255.0).pixelsOver, 0u);
    }
}

TEST(MapShadows, aShadowGoesOnFromFaceToFace)
{
    OSGKITS_NEED_GL(viewer());
    // A lamp 1 above the floor: its faces meet on the floor at a distance of 1. A bar beside it
    // throws a shadow from there to the border.
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(rectangle({0.2f, -0.1f, 0.5f}, {0.6f, 0, 0}, {0, 0.2f, 0}));
    scene->addChild(lightSource(0, osg::Vec4(0, 0, 1, 1)));
    scene->setMapSize(1024);
    const osg::ref_ptr<osg::Image> image = picture(*scene, fromAbove());
    ASSERT_TRUE(image);
    support::writeImage(*image, "map.overFaces");
    const auto isBar = [](const osg::Vec2d& p)
    { return p.x() > 0.2 && p.x() < 0.8 && std::abs(p.y()) < 0.1; };
    EXPECT_LT(wrongShare(*image, [&](const osg::Vec2d& p) { return !isBar(p) && isBar(p / 2.0); }),
              0.001);
}

TEST(MapShadows, mapsAreMadeSmallerUntilTheyFit)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(occluder(1.0));
    for (unsigned int i = 0; i < 4; ++i)
        scene->addChild(lightSource(i, osg::Vec4(float(i) - 1.5f, 0.5f, 6, 1), 0.2f));
    scene->setMapSize(1024);
    scene->setMapMegabytes(8); // 24 faces: 96 MiB of 1024, 24 of 512, 6 of 256
    ASSERT_TRUE(picture(*scene, fromAbove()));
    osgMultiRender::Plan plan = scene->getPlans().at(0);
    EXPECT_EQ(plan.counts["shadows.mapSize"], 256.0);
    EXPECT_EQ(plan.counts["shadows.mapLayers"], 24.0);
    EXPECT_EQ(plan.counts["shadows.bytes"], 6.0 * 1024 * 1024);
    EXPECT_NE(entryOf(plan, "light 0").find("6 maps of 256 (smaller than asked for)"),
              std::string::npos)
        << entryOf(plan, "light 0");
}

TEST(MapShadows, manyLightsEachHaveTheirOwnMap)
{
    OSGKITS_NEED_GL(viewer());
    // Seventy weak suns from all around: the shadow of each takes away its own share.
    constexpr unsigned int number = 70;
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(occluder(0.8));
    std::vector<osg::Vec2d> suns;
    for (unsigned int i = 0; i < number; ++i)
    {
        const double angle = 6.283 * i / number;
        suns.emplace_back(std::cos(angle), std::sin(angle));
        scene->addChild(lightSource(
            i, osg::Vec4(float(suns.back().x()), float(suns.back().y()), 1, 0), 1.2f / number));
    }
    scene->setMapSize(512);
    const osg::ref_ptr<osg::Image> image = picture(*scene, fromAbove());
    ASSERT_TRUE(image);
    support::writeImage(*image, "map.many");
    EXPECT_EQ(scene->getPlans().at(0).counts["shadows.mapLayers"], double(number));
    const double each = 255.0 * 1.2 / number / std::sqrt(2.0);
    double worst = 0.0;
    unsigned int off = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            const osg::Vec2d p = placeOf(x, y);
            if (isUnderOccluder(p))
                continue;
            unsigned int lit = 0;
            for (const osg::Vec2d& sun : suns)
                lit += !isUnderOccluder(p + sun * 0.8);
            const double error = std::abs(red(*image, x, y) - each * lit);
            worst = std::max(worst, error);
            off += error > 1.5 * each;
        }
    // An edge runs through few pixels; where many meet at a corner more lights may be off.
    EXPECT_LT(double(off) / (Width * Height), 0.02);
    EXPECT_LT(worst, 8.0 * each);
}

TEST(MapShadows, transparentSurfacesReceiveThemToo)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    osg::ref_ptr<osg::Geode> pane = floorGeode();
    osg::StateSet* state = pane->getOrCreateStateSet();
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 0.4f));
    state->setAttributeAndModes(material);
    state->setAttributeAndModes(new osg::BlendFunc);
    state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    scene->addChild(pane);
    scene->addChild(occluder(1.0));
    scene->addChild(lightSource(0, osg::Vec4(0.7f, 0, 1, 0)));
    const osg::ref_ptr<osg::Image> image = picture(*scene, fromAbove());
    ASSERT_TRUE(image);
    support::writeImage(*image, "map.transparent");
    EXPECT_GT(red(*image, 250, 128), red(*image, 80, 128) + 30) << "lit; in shadow";
}

TEST(MapShadows, theShadowStaysWhileTheCameraMoves)
{
    OSGKITS_NEED_GL(viewer());
    // The same floor, seen by cameras of different places that show the same part of it.
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(occluder(1.0));
    scene->addChild(lightSource(0, osg::Vec4(0.5f, 0.4f, 1, 0)));
    scene->setMapSize(64); // large texels
    support::CameraSpec camera = fromAbove();
    const osg::ref_ptr<osg::Image> first = picture(*scene, camera);
    for (int i = 1; i < 6; ++i)
    {
        camera.view = osg::Matrixd::lookAt(osg::Vec3d(0, 0, 20.0 + 0.7 * i), osg::Vec3d(),
                                           osg::Vec3d(0, 1, 0));
        const osg::ref_ptr<osg::Image> next = picture(*scene, camera);
        ASSERT_TRUE(first && next);
        // A pixel whose centre is on the edge of a texel may fall to either side.
        EXPECT_LT(support::difference(*first, *next, 8.0 / 255.0).getShareOver(), 0.0005) << i;
    }
}

TEST(MapShadows, withoutRoomForAMapALightHasNoShadowAndThePlanSaysSo)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(occluder(1.0));
    scene->addChild(lightSource(0, osg::Vec4(0.5f, 0.4f, 1, 0)));
    scene->setMapMegabytes(0);
    const osg::ref_ptr<osg::Image> mapped = picture(*scene, fromAbove());
    ASSERT_TRUE(mapped);
    const osgMultiRender::Plan plan = scene->getPlans().at(0);
    EXPECT_NE(entryOf(plan, "light 0").find("no shadow: there is no room for its map"),
              std::string::npos)
        << entryOf(plan, "light 0");
    scene->setShadows(Shadows::OFF);
    const osg::ref_ptr<osg::Image> plain = picture(*scene, fromAbove());
    EXPECT_EQ(support::difference(*mapped, *plain, 0.0).pixelsOver, 0u);
}

TEST(MapShadows, largeMapsAgreeWithVolumesAtAnyScale)
{
    OSGKITS_NEED_GL(viewer());
    for (const double unit : {1e-5, 1.0, 1e5})
        for (const char* type : {"directional", "spot", "point"})
        {
            osg::ref_ptr<ShadowedScene> scene = shadowed();
            osg::ref_ptr<osg::MatrixTransform> scaled =
                new osg::MatrixTransform(osg::Matrixd::scale(unit, unit, unit));
            osg::StateSet* state = scaled->getOrCreateStateSet();
            state->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
            scene->addChild(scaled);
            scaled->addChild(floorGeode());
            scaled->addChild(occluder(1.0));
            osg::ref_ptr<osg::Geode> solids = new osg::Geode;
            for (int i = 0; i < 5; ++i)
                solids->addDrawable(new osg::ShapeDrawable(new osg::Sphere(
                    osg::Vec3(-3.0f + 1.4f * i, -2.0f + 0.7f * (i % 3), 0.6f), 0.5f)));
            solids->addDrawable(
                new osg::ShapeDrawable(new osg::Box(osg::Vec3(2.0f, 2.0f, 0.8f), 0.9f)));
            scaled->addChild(solids);
            osg::ref_ptr<osg::LightSource> source = lightSource(
                0, type[0] == 'd' ? osg::Vec4(0.7f, -0.4f, 1, 0) : osg::Vec4(0.8f, -0.5f, 3, 1));
            if (type[0] == 's')
            {
                source->getLight()->setDirection(osg::Vec3(-0.1f, 0.1f, -1));
                source->getLight()->setSpotCutoff(60.0f);
            }
            scaled->addChild(source);
            support::CameraSpec camera = support::CameraSpec::perspective(
                osg::Vec3d(1, -9, 6) * unit, {0, 0, 0}, {0, 0, 1}, 45.0, 1.0, unit, 30.0 * unit);
            scene->setShadows(Shadows::VOLUMES);
            const osg::ref_ptr<osg::Image> exact = picture(*scene, camera);
            scene->setShadows(Shadows::OFF);
            const osg::ref_ptr<osg::Image> lit = picture(*scene, camera);
            scene->setShadows(Shadows::MAP);
            double share[2] = {};
            for (unsigned int large : {0u, 1u})
            {
                scene->setMapSize(large ? 2048 : 128);
                const osg::ref_ptr<osg::Image> mapped = picture(*scene, camera);
                ASSERT_TRUE(mapped && exact && lit);
                share[large] = support::difference(*mapped, *exact, 8.0 / 255.0).getShareOver();
                support::writeImage(*mapped, std::string("map.solids.") + type +
                                                 (large ? ".large" : ".small"));
            }
            support::writeImage(*exact, std::string("map.solids.") + type + ".volumes");
            std::printf("[ error    ] %s, unit %g: %.3f %% of 128 texels, %.3f %% of 2048\n", type,
                        unit, 100.0 * share[0], 100.0 * share[1]);
            EXPECT_GT(support::difference(*exact, *lit, 8.0 / 255.0).getShareOver(), 0.03);
            // Facets of the balls that look away from the light differ by the offset of the map.
            EXPECT_LT(share[1], 0.005) << type << ", " << unit;
            EXPECT_LT(share[1], 0.5 * share[0]) << type << ", " << unit;
        }
}

TEST(MapShadows, aSecondContextWithSamplesHasMapsOfItsOwn)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(occluder(1.0));
    scene->addChild(lightSource(0, osg::Vec4(2.2f, 0.3f, 1, 0)));
    const osg::ref_ptr<osg::Image> first = picture(*scene, fromAbove());
    support::HeadlessSettings settings{Width, Height};
    settings.samples = 4;
    {
        support::HeadlessViewer other(settings);
        OSGKITS_NEED_GL(other);
        other.getViewer().setLightingMode(osg::View::NO_LIGHT);
        const osg::ref_ptr<osg::Image> second = other.render(scene, fromAbove(), Width, Height, 2);
        ASSERT_TRUE(first && second);
        // Edges of the square alone are smooth: 8 units of 32 pixels, in part against the shadow.
        EXPECT_LT(support::difference(*first, *second, 2.0 / 255.0).getShareOver(), 0.01);
    }
    viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    const osg::ref_ptr<osg::Image> again = picture(*scene, fromAbove());
    ASSERT_TRUE(again);
    EXPECT_EQ(support::difference(*first, *again, 0.0).pixelsOver, 0u);
}

TEST(MapShadows, noMapsAreMadeWithoutACaster)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    osg::ref_ptr<osg::Geode> floor = floorGeode();
    floor->setUserValue("castShadow", false);
    scene->addChild(floor);
    scene->addChild(lightSource(0, osg::Vec4(0, 0, 1, 0)));
    ASSERT_TRUE(picture(*scene, fromAbove()));
    EXPECT_EQ(scene->getPlans().at(0).counts["shadows.bytes"], 0.0);
}
