// SPDX-License-Identifier: MIT
// What mirrors show.
#include "MirrorPictures.h"

#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/ValueObject>

#include <cmath>
#include <functional>

using namespace mirrorScene;
using osgMultiRender::PlanEntry;
using osgShadowVolume::LitScene;
using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;

namespace
{

/// What a wall of mirror must look like: things as they are, and reflected where the wall is.
osg::ref_ptr<osg::Image> throughHole(ShadowedScene& reflected, ShadowedScene& direct,
                                     const support::CameraSpec& from = camera())
{
    osg::ref_ptr<osg::Image> mask = wallMask(from);
    osg::ref_ptr<osg::Image> behind = picture(reflected, from);
    osg::ref_ptr<osg::Image> result = picture(direct, from);
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            if (pixel(*mask, x, y)[0] == 255)
                std::copy_n(pixel(*behind, x, y), 4, result->data(unsigned(x), unsigned(y)));
    return result;
}

/// Silhouettes and shadow edges of the two ways round differently, by a pixel at most.
support::CompareImage offEdges()
{
    return {2.0 / 255.0, 0.004, 1.0};
}

} // namespace

TEST(MirrorsGLTest, showsWhatAHoleToAMirroredCopyShows)
{
    OSGKITS_NEED_GL(viewer());
    for (const Shadows shadows : {Shadows::VOLUMES, Shadows::MAP, Shadows::OFF})
    {
        osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
        osg::ref_ptr<ShadowedScene> reflected = emptyScene();
        osg::ref_ptr<osg::MatrixTransform> behind = behindWall();
        behind->addChild(lights());
        behind->addChild(things());
        reflected->addChild(behind);
        osg::ref_ptr<ShadowedScene> direct = wallScene(wall(""));
        for (ShadowedScene* each : {scene.get(), reflected.get(), direct.get()})
        {
            each->setShadows(shadows);
            each->setMapSize(2048);
        }
        const auto expected = throughHole(*reflected, *direct);
        const auto actual = picture(*scene);
        EXPECT_TRUE(offEdges()(actual, expected, "mirrorAsHole" + std::to_string(int(shadows))));
        EXPECT_EQ(passesOf(*scene), 1.0);
        EXPECT_NE(reasonOf(*scene, "mirror 'wall'", PlanEntry::Decision::Drawn), "");
    }
}

TEST(MirrorsGLTest, lightsOfModesAndOfOutsideAndTheHeadlightReflect)
{
    OSGKITS_NEED_GL(viewer());
    const auto make = [](const osg::ref_ptr<osg::Group>& content)
    {
        osg::ref_ptr<ShadowedScene> kit = emptyScene();
        kit->setLightScope(LitScene::LightScope::MODES);
        kit->addChild(content);
        osg::ref_ptr<osg::Group> root = new osg::Group;
        root->addChild(kit);
        for (unsigned int number : {1u, 9u})
            root->getOrCreateStateSet()->setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
        return root;
    };
    // One light comes after the group, one has a number that GL has not.
    const osg::ref_ptr<osg::LightSource> after = light(1, {-2, -3, 6, 1}, {0.4f, 0.4f, 0.3f, 1});
    const osg::ref_ptr<osg::LightSource> many = light(9, {3, -4, 5, 0}, {0.2f, 0.2f, 0.4f, 1});
    osg::ref_ptr<osg::Group> content = things();
    content->addChild(many);
    osg::ref_ptr<osg::Group> withMirror = new osg::Group, withWall = new osg::Group;
    withMirror->addChild(content);
    withMirror->addChild(wall());
    withWall->addChild(content);
    withWall->addChild(wall(""));
    osg::ref_ptr<osg::Group> scene = make(withMirror), direct = make(withWall);
    scene->addChild(after);
    direct->addChild(after);
    osg::ref_ptr<osg::MatrixTransform> behind = behindWall(), afterBehind = behindWall();
    behind->addChild(content);
    afterBehind->addChild(after);
    osg::ref_ptr<osg::Group> reflected = make(behind);
    reflected->addChild(afterBehind);
    const auto mask = wallMask();
    support::HeadlessViewer& view = viewer();
    view.getViewer().setLightingMode(osg::View::HEADLIGHT);
    const auto actual = view.render(scene, camera(), Width, Height, 2);
    const auto directly = view.render(direct, camera(), Width, Height, 2);
    // The headlight stands at the viewer's mirrored eye: its direction is reflected.
    viewer().getViewer().setLightingMode(osg::View::NO_LIGHT);
    osg::ref_ptr<osg::Light> head = new osg::Light(*viewer().getViewer().getLight());
    osg::ref_ptr<osg::LightSource> headSource = new osg::LightSource;
    const osg::Matrixd toWorld = osg::Matrixd::inverse(camera().view);
    head->setPosition(osg::Vec4(osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), toWorld), 0));
    headSource->setLight(head);
    headSource->addDescription("castShadow=0");
    afterBehind->addChild(headSource);
    reflected->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    auto* kit = static_cast<ShadowedScene*>(reflected->getChild(0));
    kit->setShadows(Shadows::VOLUMES);
    osg::ref_ptr<osg::Image> expected = picture(*reflected);
    unsigned int wrong = 0, seen = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            const bool inWall = pixel(*mask, x, y)[0] == 255;
            seen += inWall;
            const osg::Image& wanted = inWall ? *expected : *directly;
            wrong += !isAlike(pixel(*actual, x, y), pixel(wanted, x, y), 2);
        }
    EXPECT_GT(seen, 8000u) << "no mirror, no proof";
    EXPECT_LT(wrong, 0.02 * Width * Height);
    support::writeImage(*actual, "mirrorOutsideLights.actual");
    support::writeImage(*expected, "mirrorOutsideLights.expected");
}

TEST(MirrorsGLTest, shadowsFallInTheReflection)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
    const auto shadowed = picture(*scene);
    scene->setShadows(Shadows::OFF);
    const auto lit = picture(*scene);
    const auto mask = wallMask();
    unsigned int darker = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            darker += pixel(*mask, x, y)[0] == 255 &&
                      pixel(*shadowed, x, y)[0] + 20 < pixel(*lit, x, y)[0];
    EXPECT_GT(darker, 100u);
}

TEST(MirrorsGLTest, reflectivityMixesSurfaceAndReflection)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<osg::Geode> mirror = wall("");
    setColor(*mirror, {0.9f, 0.6f, 0.3f, 1});
    osg::ref_ptr<ShadowedScene> scene = wallScene(mirror);
    const auto surface = picture(*scene);
    mirror->setUserValue("mirror", 1.0f);
    const auto reflection = picture(*scene);
    mirror->setUserValue("mirror", 0.25f);
    const auto mixed = picture(*scene);
    unsigned int wrong = 0, changed = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            for (int c = 0; c < 3; ++c)
            {
                const double s = pixel(*surface, x, y)[c], r = pixel(*reflection, x, y)[c];
                changed += std::abs(s - r) > 4.0;
                // Each of the three pictures is rounded, and the reflection once more on its way.
                wrong += std::abs(0.75 * s + 0.25 * r - pixel(*mixed, x, y)[c]) > 1.5;
            }
    EXPECT_GT(changed, 10000u);
    EXPECT_EQ(wrong, 0u);
}

TEST(MirrorsGLTest, glassShowsWhatIsBehindItAndReflects)
{
    OSGKITS_NEED_GL(viewer());
    const auto glass = [](float alpha, float reflectivity, bool opaqueBehind)
    {
        osg::ref_ptr<osg::Geode> pane = wall("");
        setColor(*pane, {0.4f, 0.4f, 0.4f, alpha});
        osg::StateSet* state = pane->getOrCreateStateSet();
        state->setAttributeAndModes(
            new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
        state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        pane->setUserValue("mirror", reflectivity);
        osg::ref_ptr<ShadowedScene> scene = wallScene(pane);
        if (opaqueBehind)
            scene->addChild(box({0, 4, 2}, {6, 1, 5}, {0.1f, 0.8f, 0.8f, 1}));
        return picture(*scene);
    };
    const auto through = glass(0.3f, 0.0f, true), reflection = glass(0.3f, 1.0f, true);
    const auto both = glass(0.3f, 0.4f, true);
    unsigned int wrong = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            for (int c = 0; c < 3; ++c)
                wrong += std::abs(0.6 * pixel(*through, x, y)[c] +
                                  0.4 * pixel(*reflection, x, y)[c] - pixel(*both, x, y)[c]) > 2.0;
    EXPECT_EQ(wrong, 0u);
    EXPECT_FALSE(isAlike(pixel(*through, 160, 120), pixel(*reflection, 160, 120), 4));
    support::writeImage(*both, "mirrorGlass");
}

TEST(MirrorsGLTest, whatIsBehindAMirrorDoesNotShowInIt)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
    const auto expected = picture(*scene);
    // Its reflection would cover all of the mirror; the wall throws no shadow on what is before it.
    scene->addChild(box({0, 3.2f, 1.6f}, {5, 0.5f, 2}, {1, 1, 1, 1}));
    const auto actual = picture(*scene);
    const auto mask = wallMask();
    unsigned int wrong = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            wrong += pixel(*mask, x, y)[0] == 255 &&
                     !isAlike(pixel(*actual, x, y), pixel(*expected, x, y), 1);
    EXPECT_EQ(wrong, 0u);
}

TEST(MirrorsGLTest, unlitAndVertexLitMirrorsReflect)
{
    OSGKITS_NEED_GL(viewer());
    for (const auto lighting :
         {LitScene::Lighting::OFF, LitScene::Lighting::VERTEX, LitScene::Lighting::PIXEL})
    {
        osg::ref_ptr<osg::Geode> mirror = wall();
        if (lighting == LitScene::Lighting::PIXEL)
            mirror->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        osg::ref_ptr<ShadowedScene> scene = wallScene(mirror);
        scene->setLighting(lighting);
        for (unsigned int number : {0u, 1u})
            scene->getOrCreateStateSet()->setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
        const auto reflecting = picture(*scene);
        scene->setMirrors(false);
        const auto dull = picture(*scene);
        unsigned int changed = 0;
        for (int y = 0; y < Height; ++y)
            for (int x = 0; x < Width; ++x)
                changed += !isAlike(pixel(*reflecting, x, y), pixel(*dull, x, y), 8);
        EXPECT_GT(changed, 4000u) << int(lighting);
    }
}

TEST(MirrorsGLTest, severalSamplesAndThreadsGiveTheSamePicture)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
    const auto expected = picture(*scene);
    using Viewer = osgViewer::ViewerBase;
    for (const auto threading :
         {Viewer::SingleThreaded, Viewer::CullDrawThreadPerContext, Viewer::DrawThreadPerContext,
          Viewer::CullThreadPerCameraDrawThreadPerContext})
        for (const unsigned int samples : {0u, 4u})
        {
            support::HeadlessSettings settings{Width, Height};
            settings.samples = samples;
            settings.threading = threading;
            support::HeadlessViewer other(settings);
            OSGKITS_NEED_GL(other);
            other.getViewer().setLightingMode(osg::View::NO_LIGHT);
            osg::ref_ptr<ShadowedScene> again = wallScene(wall());
            const auto actual = other.render(again, camera(), Width, Height, 6);
            // Samples smooth the edges, of which there are some 3 % of the picture.
            const support::CompareImage compare{2.0 / 255.0, samples ? 0.05 : 0.0, 1.0};
            EXPECT_TRUE(compare(actual, expected,
                                "mirrorThreads" + std::to_string(int(threading)) + "_" +
                                    std::to_string(samples)));
        }
}
