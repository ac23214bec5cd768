// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/ValueObject>

#include <cmath>
#include <cstdlib>
#include <functional>

using osgMultiRender::PlanEntry;
using osgShadowVolume::LitScene;
using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;

namespace
{

constexpr int Width = 320, Height = 240;

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    if (viewer.isValid())
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return viewer;
}

support::CameraSpec camera(const osg::Vec3d& eye = {1.0, -9.0, 4.0},
                           const osg::Vec3d& center = {0.0, 1.0, 1.0})
{
    return support::CameraSpec::perspective(eye, center, {0, 0, 1}, 50.0, double(Width) / Height,
                                            0.5, 100.0);
}

osg::ref_ptr<osg::Image> picture(osg::Node& scene, const support::CameraSpec& from = camera())
{
    return viewer().render(&scene, from, Width, Height, 2);
}

/// Nothing shines but what a test's materials and lights say.
osg::ref_ptr<ShadowedScene> emptyScene()
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setLightScope(LitScene::LightScope::ALL);
    osg::StateSet* state = scene->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0.2f, 0.2f, 0.2f, 1));
    state->setAttribute(model);
    return scene;
}

void setColor(osg::Node& node, const osg::Vec4& color, const osg::Vec4& emission = {0, 0, 0, 1})
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    material->setAmbient(osg::Material::FRONT_AND_BACK, color);
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.3f, 0.3f, 0.3f, color.a()));
    material->setShininess(osg::Material::FRONT_AND_BACK, 20.0f);
    material->setEmission(osg::Material::FRONT_AND_BACK, emission);
    node.getOrCreateStateSet()->setAttribute(material);
}

osg::ref_ptr<osg::Geode> box(const osg::Vec3& center, const osg::Vec3& size, const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(center, size.x(), size.y(), size.z())));
    setColor(*geode, color);
    return geode;
}

osg::ref_ptr<osg::Geode> quad(const osg::Vec3& corner, const osg::Vec3& u, const osg::Vec3& v,
                              const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(corner, u, v));
    setColor(*geode, color);
    return geode;
}

osg::ref_ptr<osg::LightSource> light(unsigned int number, const osg::Vec4& position,
                                     const osg::Vec4& color)
{
    osg::ref_ptr<osg::Light> made = new osg::Light(number);
    made->setPosition(position);
    made->setDiffuse(color);
    made->setSpecular(color);
    made->setAmbient(osg::Vec4(0, 0, 0, 1));
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(made);
    return source;
}

osg::ref_ptr<osg::Group> lights()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(light(0, {-2, -3, 6, 1}, {0.5f, 0.5f, 0.4f, 1}));
    group->addChild(light(1, {3, -4, 5, 0}, {0.3f, 0.3f, 0.5f, 1}));
    return group;
}

/// A table of boxes that throw shadows on each other and on the ground, all before the mirror.
osg::ref_ptr<osg::Group> things()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(quad({-4, -8, 0}, {8, 0, 0}, {0, 8, 0}, {0.8f, 0.8f, 0.7f, 1}));
    group->addChild(box({-1, -2, 0.5f}, {1, 1, 1}, {0.9f, 0.2f, 0.2f, 1}));
    group->addChild(box({0.5f, -3, 1.0f}, {0.6f, 0.6f, 2}, {0.2f, 0.9f, 0.2f, 1}));
    group->addChild(box({1.8f, -1.5f, 1.4f}, {0.5f, 0.7f, 0.4f}, {0.2f, 0.3f, 0.9f, 1}));
    return group;
}

/// A wall that leans, so that no axis is along it.
const osg::Vec3 Corner(-3.0f, 1.0f, 0.2f), Along(6.0f, 0.8f, 0.0f), Up(0.1f, -0.4f, 3.5f);

osg::ref_ptr<osg::Geode> wall(const std::string& mirror = "mirror=1")
{
    osg::ref_ptr<osg::Geode> geode = quad(Corner, Along, Up, {0, 0, 0, 1});
    geode->setName("wall");
    if (!mirror.empty())
        geode->addDescription(mirror);
    return geode;
}

/// Where a mirror in the wall shows things.
osg::ref_ptr<osg::MatrixTransform> behindWall()
{
    osg::Vec3d n = osg::Vec3d(Along) ^ osg::Vec3d(Up);
    n.normalize();
    const double d = -(n * osg::Vec3d(Corner));
    osg::Matrixd m;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            m(row, column) -= 2.0 * n[row] * n[column];
    m.setTrans(n * (-2.0 * d));
    return new osg::MatrixTransform(m);
}

const unsigned char* pixel(const osg::Image& image, int x, int y)
{
    return image.data(unsigned(x), unsigned(y));
}

bool isAlike(const unsigned char* a, const unsigned char* b, int tolerance)
{
    return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance &&
           std::abs(a[2] - b[2]) <= tolerance;
}

/// A picture of where the wall is seen: white there, black elsewhere.
osg::ref_ptr<osg::Image> wallMask(const support::CameraSpec& from = camera())
{
    osg::ref_ptr<ShadowedScene> scene = emptyScene();
    scene->setMirrors(false);
    osg::ref_ptr<osg::Group> dark = things();
    dark->getOrCreateStateSet()->setAttributeAndModes(
        new osg::Material, osg::StateAttribute::OVERRIDE | osg::StateAttribute::ON);
    auto* black = static_cast<osg::Material*>(
        dark->getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
    for (auto set :
         {&osg::Material::setDiffuse, &osg::Material::setAmbient, &osg::Material::setSpecular})
        (black->*set)(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
    scene->addChild(dark);
    osg::ref_ptr<osg::Geode> white = wall("");
    setColor(*white, {0, 0, 0, 1}, {1, 1, 1, 1});
    scene->addChild(white);
    return picture(*scene, from);
}

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

osgMultiRender::Plan planOf(const ShadowedScene& scene)
{
    for (const osgMultiRender::Plan& plan : scene.getPlans())
        if (plan.view.compare(0, 6, "mirror") != 0)
            return plan;
    return {};
}

std::string reasonOf(const ShadowedScene& scene, const std::string& subject,
                     PlanEntry::Decision decision)
{
    for (const PlanEntry& entry : planOf(scene).entries)
        if (entry.subject == subject && entry.decision == decision)
            return entry.reason;
    return "";
}

double passesOf(const ShadowedScene& scene)
{
    osgMultiRender::Plan plan = planOf(scene);
    return plan.counts.count("mirrors.passes") ? plan.counts["mirrors.passes"] : -1.0;
}

/// A camera before a single mirror and nothing else.
osg::ref_ptr<ShadowedScene> wallScene(const osg::ref_ptr<osg::Geode>& mirror)
{
    osg::ref_ptr<ShadowedScene> scene = emptyScene();
    scene->addChild(lights());
    scene->addChild(things());
    scene->addChild(mirror);
    return scene;
}

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

TEST(MirrorsGLTest, mirrorsThatDoNotShowCostNothing)
{
    OSGKITS_NEED_GL(viewer());
    struct Case
    {
        const char* reason;
        osg::Vec3d eye, center;
    };
    const osg::Vec3d middle = Corner + Along * 0.5f + Up * 0.5f;
    for (const Case& each :
         {Case{"it is behind the viewer", {0, -4, 2}, {0, -9, 2}},
          Case{"it is out of view", {0, -6, 2}, {-20, -5.5, 2}},
          Case{"it is seen edge-on", osg::Vec3d(Corner) - osg::Vec3d(Along), middle}})
    {
        osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
        scene->addChild(
            box(each.center, {1, 1, 1}, {1, 1, 1, 1})); // without leaves there is no plan
        picture(*scene, camera(each.eye, each.center));
        EXPECT_EQ(reasonOf(*scene, "mirror 'wall'", PlanEntry::Decision::Dropped), each.reason);
        EXPECT_EQ(passesOf(*scene), 0.0);
        EXPECT_EQ(scene->getPlans().size(), 1u) << "a view of a mirror has been drawn";
    }
    osg::ref_ptr<osg::Geode> oneSided = wall();
    oneSided->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace);
    osg::ref_ptr<ShadowedScene> scene = wallScene(oneSided);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 1.0) << "its front faces the viewer";
    picture(*scene, camera({0, 9, 4}, {0, 0, 1}));
    EXPECT_EQ(passesOf(*scene), 0.0) << "its back does";
    osg::ref_ptr<ShadowedScene> without = wallScene(wall(""));
    picture(*without);
    EXPECT_EQ(passesOf(*without), -1.0) << "the plan of a scene without mirrors speaks of them";
    scene = wallScene(wall());
    scene->setMirrors(false);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), -1.0);
}

TEST(MirrorsGLTest, twoMirrorsThatFaceEachOtherReflectOnce)
{
    OSGKITS_NEED_GL(viewer());
    const auto facing = [](const std::string& second)
    {
        osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
        osg::ref_ptr<osg::Geode> other =
            quad({3, -7, 0}, {0, 7, 0}, {0, 0, 3}, {0.5f, 0.1f, 0.1f, 1});
        other->setName("other");
        if (!second.empty())
            other->addDescription(second);
        scene->addChild(other);
        return scene;
    };
    const support::CameraSpec from = camera({-3, -8, 3}, {1, 0, 1.5});
    osg::ref_ptr<ShadowedScene> both = facing("mirror=1"), one = facing("");
    const auto actual = picture(*both, from), expected = picture(*one, from);
    EXPECT_EQ(passesOf(*both), 2.0);
    EXPECT_EQ(both->getPlans().size(), 3u) << "the view and one picture of each mirror";
    // In the first mirror the second one shows its own surface, as if it were none.
    const auto mask = wallMask(from);
    unsigned int wrong = 0, red = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            if (pixel(*mask, x, y)[0] != 255)
                continue;
            // Where the other mirror stands before the wall, that one reflects.
            const bool covered = !isAlike(pixel(*actual, x, y), pixel(*expected, x, y), 1);
            wrong += covered;
            const unsigned char* p = pixel(*expected, x, y);
            red += p[0] > 2 * p[1] + 20;
        }
    EXPECT_GT(red, 50u) << "the second mirror is not seen in the first";
    EXPECT_LT(wrong, 900u);
    support::writeImage(*actual, "mirrorsFacing.actual");
    support::writeImage(*expected, "mirrorsFacing.expected");
}

TEST(MirrorsGLTest, tilesOfOnePlaneShareAPicture)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> whole = wallScene(wall());
    osg::ref_ptr<ShadowedScene> tiled = emptyScene();
    tiled->addChild(lights());
    tiled->addChild(things());
    for (int i = 0; i < 3; ++i)
    {
        osg::ref_ptr<osg::Geode> tile =
            quad(Corner + Along * (float(i) / 3.0f), Along / 3.0f, Up, {0, 0, 0, 1});
        tile->setName("mirror=1 tile " + std::to_string(i));
        tiled->addChild(tile);
    }
    const auto actual = picture(*tiled), expected = picture(*whole);
    EXPECT_TRUE(support::CompareImage()(actual, expected, "mirrorTiles"));
    EXPECT_EQ(passesOf(*tiled), 1.0);
    EXPECT_NE(reasonOf(*tiled, "mirror 'mirror=1 tile 2'", PlanEntry::Decision::Folded), "");
}

TEST(MirrorsGLTest, theLargestMirrorsAreDrawnUpToTheLimit)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
    osg::ref_ptr<osg::Geode> small = quad({-3.5f, -2, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0, 1});
    small->setName("mirror_small");
    scene->insertChild(0, small);
    scene->setMaxMirrors(1);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 1.0);
    EXPECT_NE(reasonOf(*scene, "mirror 'wall'", PlanEntry::Decision::Drawn), "");
    EXPECT_NE(
        reasonOf(*scene, "mirror 'mirror_small'", PlanEntry::Decision::Dropped).find("maxmirrors"),
        std::string::npos);
    scene->setMaxMirrors(2);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 2.0);
}

TEST(MirrorsGLTest, aCurvedMirrorWarnsOnceAndReflectsNothing)
{
    OSGKITS_NEED_GL(viewer());
    support::NotifyCapture capture;
    osg::ref_ptr<osg::Geode> ball = box({0, 0, 2}, {1, 1, 1}, {0.5f, 0.5f, 0.5f, 1});
    ball->setName("mirror_ball");
    osg::ref_ptr<ShadowedScene> scene = wallScene(ball);
    picture(*scene);
    picture(*scene);
    EXPECT_EQ(capture.takeWarnings(),
              support::NotifyCapture::Lines{
                  "osgShadowVolume::ShadowedScene: mirror 'mirror_ball' is not planar, so it "
                  "reflects nothing; a mirror has to be one flat Drawable"});
    EXPECT_EQ(reasonOf(*scene, "mirror 'mirror_ball'", PlanEntry::Decision::Dropped),
              "it is not planar");
}

TEST(MirrorsGLTest, trianglesWithIndicesBeyondTheVerticesAreNoPartOfAMirror)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<osg::Geode> torn = wall();
    osg::Geometry& geometry = *torn->getDrawable(0)->asGeometry();
    // What OSG itself makes of such indices is its own affair.
    const osg::BoundingBox box = geometry.getBoundingBox();
    geometry.setInitialBound(box);
    geometry.setComputeBoundingBoxCallback(new osg::Drawable::ComputeBoundingBoxCallback);
    geometry.removePrimitiveSet(0);
    osg::ref_ptr<osg::DrawElementsUShort> elements = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (const GLushort i : {0, 1, 2, 0, 2, 3, 0, 1, 60000})
        elements->push_back(i);
    geometry.addPrimitiveSet(elements);
    osg::ref_ptr<ShadowedScene> scene = wallScene(torn);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 1.0);
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

} // namespace
