// SPDX-License-Identifier: MIT
// Shadows are made only where their light reaches.
#include <osgShadowVolume/ShadowedScene.h>

#include <support/HeadlessViewer.h>

#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Light>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cstdlib>
#include <regex>

using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;
using osgShadowVolume::Show;

namespace
{

constexpr int Width = 320, Height = 240;
constexpr int Lights = 5;

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer viewer(
        {Width, Height, 0, false, osgViewer::ViewerBase::SingleThreaded, osg::Vec4(0, 0, 0, 1)});
    if (viewer.isValid())
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return viewer;
}

support::CameraSpec camera()
{
    return support::CameraSpec::perspective({0, -14, 9}, {0, 0, 0}, {0, 0, 1}, 40.0,
                                            double(Width) / Height, 1.0, 60.0);
}

osg::ref_ptr<osg::LightSource> makeLight(int number)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setAmbient(osg::Vec4(0, 0, 0, 1));
    light->setDiffuse(osg::Vec4(0.3f, 0.3f, 0.3f, 1));
    light->setSpecular(osg::Vec4(0, 0, 0, 1));
    light->setDirection(osg::Vec3(0, 0, -1));
    switch (number)
    {
    case 0: // a small disc of the floor
        light->setPosition(osg::Vec4(-2.5f, 1.5f, 3.0f, 1.0f));
        light->setSpotCutoff(25.0f);
        break;
    case 1: // its cone leaves the screen
        light->setPosition(osg::Vec4(4.5f, -2.0f, 3.0f, 1.0f));
        light->setSpotCutoff(50.0f);
        break;
    case 2: // fades soon
        light->setPosition(osg::Vec4(0.4f, -1.2f, 1.3f, 1.0f));
        light->setQuadraticAttenuation(4.0f);
        break;
    case 3: // behind the camera
        light->setPosition(osg::Vec4(1.0f, -15.0f, 9.0f, 1.0f));
        light->setDirection(osg::Vec3(-0.07f, 0.9f, -0.55f));
        light->setSpotCutoff(14.0f);
        break;
    default:
        light->setPosition(osg::Vec4(0.4f, 0.2f, 0.8f, 0.0f));
    }
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    return source;
}

/// Balls over a floor, and with `pane` a sheet of glass before some of them.
osg::ref_ptr<ShadowedScene> makeScene(bool pane)
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setLightScope(ShadowedScene::LightScope::ALL);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}));
    for (int x = -3; x <= 3; ++x)
        for (int y = -2; y <= 2; ++y)
            geode->addDrawable(new osg::ShapeDrawable(
                new osg::Sphere(osg::Vec3(1.7f * x + 0.3f * y, 1.5f * y, 0.6f), 0.3f)));
    scene->addChild(geode);
    for (int number = 0; number < Lights; ++number)
        scene->addChild(makeLight(number));
    osg::StateSet* const state = scene->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0, 0, 0, 1));
    model->setTwoSided(true);
    state->setAttribute(model);
    if (!pane)
        return scene;
    osg::ref_ptr<osg::Geode> glass = new osg::Geode;
    glass->addDrawable(osg::createTexturedQuadGeometry({-5, -3, 0.1f}, {7, 0, 0}, {0, 1, 2}));
    osg::StateSet* const blended = glass->getOrCreateStateSet();
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 0.4f));
    blended->setAttributeAndModes(material);
    blended->setAttributeAndModes(new osg::BlendFunc);
    blended->setMode(GL_BLEND, osg::StateAttribute::ON);
    blended->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    scene->addChild(glass);
    return scene;
}

osg::ref_ptr<osg::Image> draw(ShadowedScene& scene, int light, Shadows shadows,
                              Show show = Show::PICTURE)
{
    scene.setLightShown(light);
    scene.setShadows(shadows);
    scene.setShow(show);
    return viewer().render(&scene, camera(), Width, Height);
}

/// The share of the screen that the plan of the last frame tells, percent; -1 for none.
int shareOf(ShadowedScene& scene, int light)
{
    static const std::regex words("on ([0-9]+) % of the screen");
    const auto plans = scene.getPlans();
    for (const auto& entry : plans.back().entries)
    {
        std::smatch found;
        if (entry.subject.find("light " + std::to_string(light)) == 0 &&
            std::regex_search(entry.reason, found, words))
            return std::stoi(found[1]);
    }
    return -1;
}

} // namespace

TEST(LightAreaGLTest, eachLightHasAllItsShadowsWithinItsRectangle)
{
    OSGKITS_NEED_GL(viewer());
    const osg::ref_ptr<ShadowedScene> scene = makeScene(false);
    for (int light = 0; light < Lights; ++light)
    {
        SCOPED_TRACE("light " + std::to_string(light));
        const auto open = draw(*scene, light, Shadows::OFF);
        const auto shadowed = draw(*scene, light, Shadows::VOLUMES);
        // Masks are made on the whole screen.
        const auto mask = draw(*scene, light, Shadows::VOLUMES, Show::MASK);
        ASSERT_TRUE(open && shadowed && mask);
        unsigned int dark = 0;
        for (int y = 0; y < Height; ++y)
            for (int x = 0; x < Width; ++x)
            {
                const int expected = mask->data(x, y)[0] ? open->data(x, y)[0] : 0;
                dark += expected != open->data(x, y)[0];
                // What a light with a reach leaves out is less than half a step: one step when
                // rounded.
                ASSERT_NEAR(shadowed->data(x, y)[0], expected, 1) << x << ' ' << y;
            }
        EXPECT_GT(dark, 20u);
    }
}

TEST(LightAreaGLTest, allLightsTogetherAreTheSumOfEach)
{
    OSGKITS_NEED_GL(viewer());
    const osg::ref_ptr<ShadowedScene> scene = makeScene(true);
    const auto all = draw(*scene, -1, Shadows::VOLUMES);
    std::vector<osg::ref_ptr<osg::Image>> each;
    for (int light = 0; light < Lights; ++light)
        each.push_back(draw(*scene, light, Shadows::VOLUMES));
    ASSERT_TRUE(all);
    unsigned int wrong = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            int sum = 0;
            for (const auto& image : each)
                sum += image->data(x, y)[0];
            // Each of them is rounded, twice below the pane, which may be clamped by the sum.
            wrong += sum < 255 && std::abs(sum - all->data(x, y)[0]) > 2 * Lights;
        }
    EXPECT_EQ(wrong, 0u);
}

TEST(LightAreaGLTest, thePlanNamesTheShareOfTheScreen)
{
    OSGKITS_NEED_GL(viewer());
    const osg::ref_ptr<ShadowedScene> scene = makeScene(false);
    ASSERT_TRUE(draw(*scene, -1, Shadows::VOLUMES));
    EXPECT_GT(shareOf(*scene, 0), 2);
    EXPECT_LT(shareOf(*scene, 0), 30);
    EXPECT_LT(shareOf(*scene, 1), 60);
    EXPECT_EQ(shareOf(*scene, 4), 100);
}

TEST(LightAreaGLTest, aLightThatIsOffTheScreenMakesNoShadows)
{
    OSGKITS_NEED_GL(viewer());
    const osg::ref_ptr<ShadowedScene> scene = makeScene(false);
    const osg::ref_ptr<osg::LightSource> aside = makeLight(0);
    aside->getLight()->setLightNum(7);
    aside->getLight()->setPosition(osg::Vec4(30.0f, 0.0f, 3.0f, 1.0f));
    scene->addChild(aside);
    ASSERT_TRUE(draw(*scene, 7, Shadows::VOLUMES));
    EXPECT_EQ(shareOf(*scene, 7), -1);
    EXPECT_EQ(scene->getPlans().back().counts["shadows.lights"], 0.0);
}
