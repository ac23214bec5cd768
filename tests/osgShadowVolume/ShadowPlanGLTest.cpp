// SPDX-License-Identifier: MIT
#include "VolumePictures.h"

#include <support/NotifyCapture.h>

#include <osg/Billboard>
#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/ValueObject>
#include <osgText/Text>

using namespace volumeScene;
using floorScene::floorGeode;
using floorScene::fromAbove;
using floorScene::lightSource;
using osgShadowVolume::ShadowedScene;
using support::CameraSpec;
using Picture = osg::ref_ptr<osg::Image>;
using Build = std::function<void(ShadowedScene&)>;

// What the plan leaves out must not show. The proof is the same scene without bounds: of what
// nobody knows where it is, nothing can be left out.

namespace
{

class ShadowPlan : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(floorScene::viewer()); }

    /// Draws the scene as planned, which says `expected` of light 0, and with everything drawn:
    /// both pictures are the same but for `tolerance`. Returns the picture.
    static Picture expectUnseen(const std::string& name, const CameraSpec& camera,
                                const std::string& expected, const Build& build,
                                double tolerance = 0.0)
    {
        const osg::ref_ptr<ShadowedScene> planned = shadowed(), forced = shadowed();
        build(*planned);
        build(*forced);
        forgetBounds(*forced);
        const Picture actual = render(*planned, camera), all = render(*forced, camera);
        const std::string entry = entryOf(*planned, "light 0");
        EXPECT_NE(entry.find(expected), std::string::npos) << name << ": " << entry;
        // A light that reaches no pixel has no shadow even then, but shines.
        const std::string casters = std::to_string(int(countOf(*forced, "shadows.casters")));
        const std::string drawn = entryOf(*forced, "light 0");
        if (expected.rfind("dropped", 0) == 0)
        {
            EXPECT_EQ(drawn.find("dropped"), std::string::npos) << name << ": " << drawn;
        }
        else
        {
            EXPECT_EQ(drawn.rfind("drawn: " + casters + " caster", 0), 0u) << name << ": " << drawn;
            EXPECT_NE(drawn.find("z-fail for " + casters), std::string::npos) << name;
        }
        EXPECT_TRUE((support::CompareImage{tolerance, 0.0, tolerance}(actual, all, name)));
        keep(actual, name);
        keep(all, name + ".all");
        return actual;
    }

    support::NotifyCapture _notify;
};

/// A light that lights the floor without shadow, so that nothing is black by chance.
osg::ref_ptr<osg::LightSource> fill(unsigned int number)
{
    osg::ref_ptr<osg::LightSource> source =
        lightSource(number, osg::Vec4(0.2f, -0.3f, 1.0f, 0.0f), 0.3f);
    source->setUserValue("castShadow", false);
    return source;
}

} // namespace

TEST_F(ShadowPlan, aLightOutOfRangeIsNotMissed)
{
    // Half a step of 8 bits may be missing; a value may round to the next one.
    expectUnseen(
        "plan.range", fromAbove(), "dropped: it reaches nothing in view",
        [](ShadowedScene& scene)
        {
            scene.addChild(floorGeode());
            scene.addChild(box({0, 0, 1}, 1));
            const auto far = lightSource(0, osg::Vec4(60, 0, 30, 1));
            far->getLight()->setQuadraticAttenuation(1.0f);
            scene.addChild(far);
            scene.addChild(fill(1));
        },
        1.0 / 255.0);
}

TEST_F(ShadowPlan, aLightWhoseConeMissesTheViewIsNotMissed)
{
    expectUnseen("plan.cone", fromFront(), "dropped: it reaches nothing in view",
                 [](ShadowedScene& scene)
                 {
                     scene.addChild(floorGeode());
                     scene.addChild(box({0, 0, 1}, 1));
                     const auto spot = lightSource(0, osg::Vec4(7, 0, 3, 1));
                     spot->getLight()->setDirection(osg::Vec3(1, 0, 0));
                     spot->getLight()->setSpotCutoff(25.0f);
                     scene.addChild(spot);
                     scene.addChild(fill(1));
                 });
}

TEST_F(ShadowPlan, aLightWithoutACasterBeforeItIsFolded)
{
    const char* const reason = "folded: in the one pass of all unshadowed lights: no caster";
    const osg::Vec4 lights[] = {osg::Vec4(0, 0, 1, 0), osg::Vec4(1, -1, 5, 1)};
    for (const osg::Vec4& position : lights)
        expectUnseen("plan.noCaster" + std::to_string(int(position.w())), fromAbove(), reason,
                     [&](ShadowedScene& scene)
                     {
                         // Behind the light as seen from the floor, or beside its way there.
                         const auto floor = floorGeode();
                         floor->setUserValue("castShadow", false);
                         scene.addChild(floor);
                         if (position.w() != 0.0f)
                             scene.addChild(moved({1, -1, 30}, box({}, 1)));
                         scene.addChild(moved({40, 0, 9}, box({}, 1)));
                         scene.addChild(lightSource(0, position));
                     });
}

TEST_F(ShadowPlan, aCasterOutOfViewThatThrowsItsShadowIntoItCounts)
{
    // 2 above the picture's upper edge; its shadow falls 4 below.
    const Picture picture = expectUnseen("plan.outside", fromAbove(), "drawn: 2 casters",
                                         [](ShadowedScene& scene)
                                         {
                                             scene.addChild(floorGeode());
                                             scene.addChild(moved({0, 6, 4}, box({}, 2)));
                                             scene.addChild(lightSource(0, osg::Vec4(0, 1, 1, 0)));
                                         });
    ASSERT_TRUE(picture);
    // Its slab of depth 2 shades y from 0 to 4, of which the picture shows all: 2 of 8 by 4 of 8.
    EXPECT_NEAR(darkShare(*picture), 8.0 / 64.0, 0.01);
}

TEST_F(ShadowPlan, castersWhoseShadowsMissTheViewAreLeftOut)
{
    for (const osg::Vec4& position : {osg::Vec4(1, 0.5f, 2, 0), osg::Vec4(2, 1, 6, 1)})
    {
        const Picture picture = expectUnseen(
            "plan.leftOut" + std::to_string(int(position.w())), fromFront(), "drawn: 2 casters",
            [&](ShadowedScene& scene)
            {
                scene.addChild(floorGeode());
                for (float x : {0.0f, 30.0f, -30.0f, 60.0f})
                    scene.addChild(moved({x, 0.5f * x, 1.5f}, box({}, 1)));
                scene.addChild(lightSource(0, position));
            });
        ASSERT_TRUE(picture);
        EXPECT_GT(darkShare(*picture), 0.01);
    }
}

TEST_F(ShadowPlan, zPassAndZFailGiveOneMask)
{
    for (const osg::Vec4& position :
         {osg::Vec4(1, 0.5f, 2, 0), osg::Vec4(2, 1, 6, 1), osg::Vec4(0.1f, 0.2f, 1.8f, 1)})
        for (const auto technique :
             {osgShadowVolume::Technique::TESS, osgShadowVolume::Technique::GEOMETRY,
              osgShadowVolume::Technique::CPU})
            expectUnseen("plan.zPass", fromFront(), ", z-fail for 0",
                         [&](ShadowedScene& scene)
                         {
                             scene.setShow(osgShadowVolume::Show::MASK);
                             scene.setTechnique(technique);
                             scene.addChild(floorGeode());
                             scene.addChild(box({0, 0, 1}, 1));
                             scene.addChild(box({-1.5f, 0.5f, 0.8f}, 0.5f));
                             scene.addChild(lightSource(0, position));
                         });
}

TEST_F(ShadowPlan, castersBeforeTheNearPlaneAreCountedByZFail)
{
    // One caster holds the eye in its shadow, which goes on to the floor.
    const osg::Vec3 eye(0, -9, 7), toLight(0.05f, -1, 1);
    expectUnseen("plan.zFail", fromFront(), "3 casters, z-fail for 1",
                 [&](ShadowedScene& scene)
                 {
                     scene.addChild(floorGeode());
                     for (const osg::Vec3& place : {osg::Vec3(0, 0, 1.5f), eye + toLight * 2.0f})
                         scene.addChild(moved(place, box({}, 1)));
                     scene.addChild(lightSource(0, osg::Vec4(toLight, 0)));
                 });
}

TEST_F(ShadowPlan, aLightAtTheEyeIsFolded)
{
    const Picture picture = expectUnseen(
        "plan.atEye", fromFront(), "folded: in the one pass of all unshadowed lights: its shadows",
        [](ShadowedScene& scene)
        {
            scene.addChild(floorGeode());
            scene.addChild(box({0, 0, 1}, 1));
            scene.addChild(lightSource(0, osg::Vec4(0, -9, 7, 1)));
        });
    ASSERT_TRUE(picture);
    EXPECT_LT(darkShare(*picture), 0.001);
}

TEST_F(ShadowPlan, aLightAlongAnOrthographicViewIsFolded)
{
    const Picture picture = expectUnseen(
        "plan.along", fromAbove(), "folded: in the one pass of all unshadowed lights: its shadows",
        [](ShadowedScene& scene)
        {
            scene.addChild(floorGeode());
            scene.addChild(box({0.03f, 0.04f, 1}, 1.01f));
            scene.addChild(lightSource(0, osg::Vec4(0, 0, 1, 0)));
        });
    ASSERT_TRUE(picture);
    EXPECT_LT(darkShare(*picture), 0.001);
}

TEST_F(ShadowPlan, alongAnOrthographicViewWhatIsCutAwayCasts)
{
    // A plan of a building: the light comes from above, the roof lies before the near plane.
    CameraSpec cut = fromAbove();
    cut.projection = osg::Matrixd::ortho(-4, 4, -4, 4, 10, 40);
    for (const float slope : {0.0f, 1e-9f, 1e-7f, 1e-5f, 1e-3f})
        for (const auto technique :
             {osgShadowVolume::Technique::TESS, osgShadowVolume::Technique::GEOMETRY,
              osgShadowVolume::Technique::CPU})
        {
            const auto scene = shadowed();
            scene->setTechnique(technique);
            scene->addChild(floorGeode());
            scene->addChild(moved({1.5f, 1.5f, 1}, box({}, 1)));
            scene->addChild(moved({-1.5f, 0, 15}, box({}, 2)));
            scene->addChild(lightSource(0, osg::Vec4(slope, -slope, 1, 0)));
            const Picture picture = render(*scene, cut);
            ASSERT_TRUE(picture);
            const std::string name = "plan.cut." + std::to_string(int(technique));
            keep(picture, name);
            // The roof's square of side 2; 1e-3 shifts it by a pixel's half.
            EXPECT_NEAR(darkShare(*picture), 4.0 / 64.0, 0.003) << slope << ", " << name;
        }
}

TEST_F(ShadowPlan, theHeadlightCastsWhereItIsTold)
{
    const osg::ref_ptr<ShadowedScene> scene = shadowed();
    scene->addChild(floorGeode());
    scene->addChild(box({2, 0, 2}, 1));
    support::HeadlessViewer& viewer = floorScene::viewer();
    viewer.getViewer().setLightingMode(osg::View::HEADLIGHT);
    const auto look = [&](const CameraSpec& camera)
    { return viewer.render(scene, camera, floorScene::Width, floorScene::Height, 2); };
    scene->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    const Picture plain = look(fromFront());
    EXPECT_NE(entryOf(*scene, "light 0").find("folded: "), std::string::npos);
    EXPECT_NE(entryOf(*scene, "light 0").find("headlight=noshadow"), std::string::npos);
    EXPECT_EQ(countOf(*scene, "shadows.bytes"), 0.0);
    scene->setHeadlightShadow(true);
    const Picture cast = look(fromFront());
    EXPECT_EQ(entryOf(*scene, "light 0").rfind("drawn: 1 caster", 0), 0u);
    // Directional: along an orthographic view it has nothing to show.
    look(fromAbove());
    EXPECT_NE(entryOf(*scene, "light 0").find("its shadows hide"), std::string::npos);
    ASSERT_TRUE(plain && cast);
    keep(plain, "plan.headlight.noshadow");
    keep(cast, "plan.headlight.shadow");
    EXPECT_GT(support::difference(*plain, *cast, 0.1).getShareOver(), 0.005);
}

TEST_F(ShadowPlan, castShadow0IsHeardOnEverything)
{
    enum class On
    {
        NOTHING,
        NODE,
        DRAWABLE,
        SOURCE,
        LIGHT
    };
    for (const On where : {On::NOTHING, On::NODE, On::DRAWABLE, On::SOURCE, On::LIGHT})
    {
        const osg::ref_ptr<ShadowedScene> scene = shadowed();
        const auto floor = floorGeode();
        scene->addChild(floor);
        const auto caster = box({0, 0, 2}, 1);
        scene->addChild(caster);
        const auto source = lightSource(0, osg::Vec4(1, 0, 1, 0));
        scene->addChild(source);
        if (where == On::NODE)
            caster->setUserValue("castShadow", false);
        if (where == On::DRAWABLE)
            caster->getDrawable(0)->setUserValue("castShadow", 0);
        if (where == On::SOURCE)
            source->addDescription("castShadow=0");
        if (where == On::LIGHT)
            source->getLight()->setUserValue("castShadow", std::string("false"));
        const Picture picture = render(*scene, fromAbove());
        ASSERT_TRUE(picture);
        const bool casts = where == On::NOTHING;
        // The cube's shadow reaches from 1.5 to 3 to the left of it.
        EXPECT_NEAR(darkShare(*picture), casts ? 2.0 / 64.0 : 0.0, casts ? 0.01 : 0.0)
            << int(where);
        if (where == On::SOURCE || where == On::LIGHT)
        {
            EXPECT_NE(entryOf(*scene, "light 0").find("it says castShadow=0"), std::string::npos);
            EXPECT_EQ(countOf(*scene, "shadows.bytes"), 0.0);
        }
        else if (!casts)
        {
            EXPECT_EQ(entryOf(*scene, "1 castShadow=0"), "dropped: these cast no shadow");
        }
    }
}

TEST_F(ShadowPlan, billboardsTextLinesAndPointsCastNothing)
{
    const auto build = [](bool others)
    {
        const osg::ref_ptr<ShadowedScene> scene = shadowed();
        scene->addChild(floorGeode());
        scene->addChild(box({0, 0, 2}, 1));
        scene->addChild(lightSource(0, osg::Vec4(1, 0, 1, 0)));
        if (!others)
            return scene;
        // Above the eye's near plane: they are not seen, but light comes past them.
        osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
        billboard->addDrawable(osg::createTexturedQuadGeometry(
                                   osg::Vec3(-1, 0, -1), osg::Vec3(2, 0, 0), osg::Vec3(0, 0, 2)),
                               osg::Vec3(24, 0, 24));
        scene->addChild(billboard);
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        osg::ref_ptr<osgText::Text> text = new osgText::Text;
        text->setText("shade");
        text->setCharacterSize(2.0f);
        text->setPosition(osg::Vec3(23, -1, 24));
        geode->addDrawable(text);
        for (GLenum mode : {GL_LINES, GL_POINTS, GL_LINE_STRIP})
        {
            osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
            osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
            for (int i = 0; i < 4; ++i)
                vertices->push_back(osg::Vec3(float(22 + i), float(i & 1), 24));
            geometry->setVertexArray(vertices);
            geometry->addPrimitiveSet(new osg::DrawArrays(mode, 0, 4));
            geode->addDrawable(geometry);
        }
        scene->addChild(geode);
        return scene;
    };
    const auto alone = build(false), together = build(true);
    const Picture expected = render(*alone, fromAbove()), actual = render(*together, fromAbove());
    EXPECT_TRUE(areEqual(actual, expected, "plan.noCasters"));
    EXPECT_EQ(countOf(*together, "shadows.casters"), countOf(*alone, "shadows.casters"));
    for (const char* subject : {"1 billboards", "1 texts", "3 points and lines"})
        EXPECT_EQ(entryOf(*together, subject), "dropped: these cast no shadow") << subject;
}

namespace
{

struct Objects
{
    int framebuffers = 0, programs = 0, textures = 0;
};

/// What lives in the current context, by names: drivers give small numbers.
Objects objectsOf(support::HeadlessViewer& viewer)
{
    const auto* gl =
        viewer.getViewer().getCamera()->getGraphicsContext()->getState()->get<osg::GLExtensions>();
    GLboolean(GL_APIENTRY * isFramebuffer)(GLuint) = nullptr;
    osg::setGLExtensionFuncPtr(isFramebuffer, "glIsFramebuffer");
    Objects objects;
    for (GLuint name = 1; name < 1000; ++name)
    {
        objects.framebuffers += isFramebuffer(name) != GL_FALSE;
        objects.programs += gl->glIsProgram(name) != GL_FALSE;
        objects.textures += glIsTexture(name) != GL_FALSE;
    }
    return objects;
}

/// Of a context that has drawn the scene alone.
Objects objectsFor(ShadowedScene& scene, osg::View::LightingMode lighting)
{
    support::HeadlessViewer viewer({64, 64});
    viewer.getViewer().setLightingMode(lighting);
    EXPECT_TRUE(viewer.render(&scene, fromFront(), 64, 64, 3));
    return objectsOf(viewer);
}

} // namespace

TEST_F(ShadowPlan, nothingIsAllocatedWithoutAShadowingLight)
{
    enum class Lights
    {
        NONE,
        HEADLIGHT,
        WITHOUT_SHADOW,
        SHADOWING
    };
    for (const Lights lights :
         {Lights::NONE, Lights::HEADLIGHT, Lights::WITHOUT_SHADOW, Lights::SHADOWING})
    {
        const auto build = [&](osgShadowVolume::Shadows shadows)
        {
            const osg::ref_ptr<ShadowedScene> scene = shadowed();
            scene->setShadows(shadows);
            scene->addChild(floorGeode());
            scene->addChild(box({0, 0, 1}, 1));
            scene->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
            if (lights == Lights::WITHOUT_SHADOW)
                scene->addChild(fill(0));
            if (lights == Lights::SHADOWING)
                scene->addChild(lightSource(0, osg::Vec4(1, 0, 1, 0)));
            return scene;
        };
        const auto scene = build(osgShadowVolume::Shadows::VOLUMES);
        const auto mode = lights == Lights::HEADLIGHT ? osg::View::HEADLIGHT : osg::View::NO_LIGHT;
        const Objects with = objectsFor(*scene, mode);
        const auto plain = build(osgShadowVolume::Shadows::OFF);
        const Objects without = objectsFor(*plain, mode);
        if (lights == Lights::SHADOWING)
        {
            EXPECT_GT(with.framebuffers, 0) << "or the test sees nothing";
            EXPECT_GT(with.programs, without.programs);
            EXPECT_GT(with.textures, without.textures);
            EXPECT_GT(countOf(*scene, "shadows.bytes"), 0.0);
            continue;
        }
        EXPECT_EQ(with.framebuffers, 0) << int(lights);
        EXPECT_EQ(with.programs, without.programs) << int(lights);
        EXPECT_EQ(with.textures, without.textures) << int(lights);
        EXPECT_EQ(countOf(*scene, "shadows.bytes"), 0.0) << int(lights);
        EXPECT_EQ(countOf(*scene, "shadows.drawCalls"), 0.0) << int(lights);
    }
}
