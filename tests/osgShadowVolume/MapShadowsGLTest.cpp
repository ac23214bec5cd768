// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Light>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;

namespace
{

constexpr int Width = 256, Height = 256;

/// A floor z = 0 from -4 to 4, seen from above in full: pixels are places on it.
support::CameraSpec fromAbove()
{
    support::CameraSpec spec;
    spec.view = osg::Matrixd::lookAt(osg::Vec3d(0, 0, 20), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    spec.projection = osg::Matrixd::ortho(-4, 4, -4, 4, 1, 40);
    return spec;
}

osg::Vec2d placeOf(int x, int y)
{
    return {-4.0 + 8.0 * (x + 0.5) / Width, -4.0 + 8.0 * (y + 0.5) / Height};
}

osg::ref_ptr<osg::Geode> rectangle(const osg::Vec3& corner, const osg::Vec3& width,
                                   const osg::Vec3& height)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(corner, width, height));
    return geode;
}

osg::ref_ptr<osg::Geode> floorGeode()
{
    return rectangle({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
}

/// A square of side 2 around the z axis, turned by 30 degrees so that no texel runs along it.
osg::ref_ptr<osg::Geode> occluder(double z)
{
    const osg::Vec3 u(std::cos(0.5236f), std::sin(0.5236f), 0), v(-u.y(), u.x(), 0);
    return rectangle(osg::Vec3(0, 0, float(z)) - u - v, u * 2, v * 2);
}

bool isUnderOccluder(const osg::Vec2d& p)
{
    const osg::Vec2d u(std::cos(0.5236), std::sin(0.5236));
    return std::abs(p * u) < 1.0 && std::abs(p * osg::Vec2d(-u.y(), u.x())) < 1.0;
}

osg::ref_ptr<osg::LightSource> lightSource(unsigned int number, const osg::Vec4& position,
                                           float brightness = 1.0f)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setPosition(position);
    light->setAmbient(osg::Vec4(0, 0, 0, 1));
    light->setDiffuse(osg::Vec4(brightness, brightness, brightness, 1));
    light->setSpecular(osg::Vec4(0, 0, 0, 1));
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    return source;
}

osg::ref_ptr<ShadowedScene> shadowed()
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setShadows(Shadows::MAP);
    scene->setLightScope(osgShadowVolume::LitScene::LightScope::ALL);
    osg::StateSet* state = scene->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0, 0, 0, 1)); // shadows are black
    state->setAttribute(model);
    return scene;
}

/// Its viewer has no light of its own.
support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    if (viewer.isValid())
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return viewer;
}

osg::ref_ptr<osg::Image> picture(ShadowedScene& scene, const support::CameraSpec& camera)
{
    return viewer().render(&scene, camera, Width, Height, 2);
}

int red(const osg::Image& image, int x, int y)
{
    return *image.data(x, y);
}

/// The share of pixels that are dark where `expected` says lit, or the other way round.
double wrongShare(const osg::Image& image, const std::function<bool(const osg::Vec2d&)>& inShadow)
{
    unsigned int wrong = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            wrong += (red(image, x, y) < 20) != inShadow(placeOf(x, y));
    return double(wrong) / (Width * Height);
}

std::string entryOf(const osgMultiRender::Plan& plan, const std::string& subject)
{
    for (const osgMultiRender::PlanEntry& entry : plan.entries)
        if (entry.subject.find(subject) != std::string::npos)
            return std::string(toString(entry.decision)) + ": " + entry.reason;
    return {};
}

} // namespace

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
    // A texel is 2 pixels, up to 5 along the light; staircases differ by a little of it.
    EXPECT_LT((middle[1] - middle[0]).length(), 0.4) << "it does not move";
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
