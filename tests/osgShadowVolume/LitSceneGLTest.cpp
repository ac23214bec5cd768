// SPDX-License-Identifier: MIT
#include "LitPictures.h"

#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <osg/GLExtensions>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/ShapeDrawable>
#include <osg/TexEnv>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgGA/StateSetManipulator>

#include <map>
#include <sstream>

using lit::ball;
using lit::expectSameAsStock;
using lit::Lighting;
using lit::lightSource;

namespace
{

osg::ref_ptr<osg::Texture2D> checkers(unsigned int seed)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int i = 0; i < 64; ++i)
    {
        const bool odd = (i / 8 + i) & 1;
        image->data()[3 * i] = odd ? 255 : 40;
        image->data()[3 * i + 1] = static_cast<unsigned char>(seed * 90);
        image->data()[3 * i + 2] = odd ? 60 : 255;
    }
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return texture;
}

osg::ref_ptr<osg::Material> material(const osg::Vec4& diffuse)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, diffuse);
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.5f, 0.5f, 0.5f, 1));
    material->setShininess(osg::Material::FRONT_AND_BACK, 20.0f);
    material->setDataVariance(osg::Object::DYNAMIC);
    return material;
}

/// A scene with state that changes at run time, and with what changes it.
struct Changing
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::Geode> first = ball({-0.9f, 0, 0}), second = ball({0.9f, 0, 0});
    osg::ref_ptr<osg::Material> ownMaterial = material(osg::Vec4(1, 0.6f, 0.2f, 1));
    osg::ref_ptr<osg::LightSource> source;

    explicit Changing(osg::Group& kit)
    {
        source = static_cast<osg::LightSource*>(lightSource(1, osg::Vec4(2, -3, 2, 0),
                                                            osg::Vec4(0.2f, 0.7f, 1, 1),
                                                            *root->getOrCreateStateSet())
                                                    .get());
        kit.addChild(source);
        kit.addChild(first);
        kit.addChild(second);
        first->getOrCreateStateSet()->setAttribute(ownMaterial);
        second->getOrCreateStateSet()->setTextureAttributeAndModes(0, checkers(0));
        root->addChild(&kit);
    }
};

using Step = std::function<void(Changing&)>;

/// Text of a subgraph as it would be saved.
std::string saved(osg::Node& node)
{
    std::ostringstream text;
    osg::ref_ptr<osgDB::Options> options = new osgDB::Options("fileType=Ascii");
    auto* writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgt");
    EXPECT_TRUE(writer && writer->writeNode(node, text, options).success());
    return text.str();
}

std::string firstDifference(const std::string& a, const std::string& b)
{
    std::size_t at = 0;
    while (at < a.size() && at < b.size() && a[at] == b[at])
        ++at;
    const std::size_t from = at < 200 ? 0 : at - 200;
    return " at " + std::to_string(at) + ":\n" + a.substr(from, 300) + "\n--- was ---\n" +
           b.substr(from, 300);
}

class LitSceneState : public testing::Test
{
protected:
    void SetUp() override
    {
        OSGKITS_NEED_GL(lit::viewer());
        osg::Camera& camera = *lit::viewer().getViewer().getCamera();
        _cameraState = camera.getStateSet();
        camera.setStateSet(new osg::StateSet(*_cameraState));
    }
    /// Gives the camera its own state back.
    void TearDown() override { lit::viewer().getViewer().getCamera()->setStateSet(_cameraState); }

    support::NotifyCapture _notify;
    osg::ref_ptr<osg::StateSet> _cameraState;
};

/// Counts the GL objects of the context.
class ObjectCount : public osg::Camera::DrawCallback
{
public:
    void operator()(osg::RenderInfo& renderInfo) const override
    {
        const auto* gl = renderInfo.getState()->get<osg::GLExtensions>();
        programs = textures = 0;
        for (GLuint name = 1; name < 4096; ++name)
        {
            programs += gl->glIsProgram(name) == GL_TRUE;
            textures += glIsTexture(name) == GL_TRUE;
        }
    }
    mutable unsigned int programs = 0, textures = 0;
};

} // namespace

TEST_F(LitSceneState, theKeysOfOsgviewerAreFollowed)
{
    osgViewer::Viewer& viewer = lit::viewer().getViewer();
    osg::ref_ptr<osgGA::StateSetManipulator> keys =
        new osgGA::StateSetManipulator(viewer.getCamera()->getStateSet());
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::VERTEX);
    Changing stock(*plain), scene(*kit);
    osg::ref_ptr<osg::Image> before = lit::picture(*stock.root);
    // l: lighting, t: texturing, b: back faces, w: lines, points and filled; each off and on again.
    for (const char key : std::string("lltbtblwwtltwlwwt"))
    {
        osg::ref_ptr<osgGA::GUIEventAdapter> event = new osgGA::GUIEventAdapter;
        event->setEventType(osgGA::GUIEventAdapter::KEYDOWN);
        event->setKey(key);
        EXPECT_TRUE(keys->handle(*event, viewer));
        const osg::ref_ptr<osg::Image> expected = lit::picture(*stock.root, 1);
        const osg::ref_ptr<osg::Image> actual = lit::picture(*scene.root, 1);
        EXPECT_TRUE(support::CompareImage()(actual, expected, std::string("lit.key.") + key));
        if (key != 'b')
        {
            EXPECT_TRUE(lit::differ(*expected, *before)) << "key " << key << " changes nothing";
        }
        before = expected;
    }
    EXPECT_EQ(lit::planOf(*kit).counts.at("leaves.fixedFunction"), 0.0);
}

TEST_F(LitSceneState, pixelLightingFollowsTheKeysToo)
{
    osgViewer::Viewer& viewer = lit::viewer().getViewer();
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    Changing scene(*kit);
    osg::StateSet* camera = viewer.getCamera()->getStateSet();
    const osg::ref_ptr<osg::Image> shaded = lit::picture(*scene.root);
    const auto off = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;
    camera->setMode(GL_LIGHTING, off);
    const osg::ref_ptr<osg::Image> unlit = lit::picture(*scene.root, 1);
    EXPECT_EQ(lit::planOf(*kit).counts.at("lights.drawn"), 0.0);
    camera->setTextureMode(0, GL_TEXTURE_2D, off);
    const osg::ref_ptr<osg::Image> bare = lit::picture(*scene.root, 1);
    TearDown();
    EXPECT_TRUE(lit::differ(*shaded, *unlit));
    EXPECT_TRUE(lit::differ(*unlit, *bare));
    EXPECT_TRUE(support::CompareImage()(lit::picture(*scene.root, 1), shaded, "lit.keysBack"));
}

TEST_F(LitSceneState, changesAtRunTimeShowInTheNextFrame)
{
    const std::vector<std::pair<const char*, Step>> steps = {
        {"texture",
         [](Changing& s) { s.second->getStateSet()->setTextureAttributeAndModes(0, checkers(2)); }},
        {"texturePlace",
         [](Changing& s) { s.first->getStateSet()->setTextureAttributeAndModes(0, checkers(1)); }},
        {"environment",
         [](Changing& s) {
             s.second->getStateSet()->setTextureAttribute(0, new osg::TexEnv(osg::TexEnv::REPLACE));
         }},
        {"noTexture", [](Changing& s)
         { s.first->getStateSet()->setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF); }},
        {"colorMode", [](Changing& s) { s.ownMaterial->setColorMode(osg::Material::DIFFUSE); }},
        {"colorModeOff", [](Changing& s) { s.ownMaterial->setColorMode(osg::Material::OFF); }},
        {"material", [](Changing& s)
         { s.ownMaterial->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0.2f, 1, 1)); }},
        {"pointLight",
         [](Changing& s) { s.source->getLight()->setPosition(osg::Vec4(1, -2, 1, 1)); }},
        {"attenuation", [](Changing& s) { s.source->getLight()->setLinearAttenuation(0.4f); }},
        {"spotLight",
         [](Changing& s)
         {
             s.source->getLight()->setPosition(osg::Vec4(0.9f, -3, 0, 1));
             s.source->getLight()->setDirection(osg::Vec3(0, 1, 0));
             s.source->getLight()->setSpotCutoff(14.0f);
         }},
        {"directional",
         [](Changing& s)
         {
             s.source->getLight()->setPosition(osg::Vec4(-1, -1, 0, 0));
             s.source->getLight()->setSpotCutoff(180.0f);
         }},
        {"lightOff",
         [](Changing& s) { s.first->getStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::OFF); }},
        {"lightOverride",
         [](Changing& s)
         {
             s.root->getStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON |
                                                           osg::StateAttribute::OVERRIDE);
         }},
        {"lightProtected",
         [](Changing& s)
         {
             s.first->getStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::OFF |
                                                            osg::StateAttribute::PROTECTED);
         }},
        {"newGeode",
         [](Changing& s) {
             s.first->getParent(0)->addChild(ball({0, -0.5f, 1}, osg::Vec4(1, 1, 0, 1)));
         }},
        {"lightModel",
         [](Changing& s)
         {
             osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
             model->setAmbientIntensity(osg::Vec4(0.6f, 0.1f, 0.1f, 1));
             s.root->getStateSet()->setAttribute(model);
         }},
    };
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::VERTEX);
    Changing stock(*plain), scene(*kit);
    osg::ref_ptr<osg::Image> before = lit::picture(*stock.root);
    lit::picture(*scene.root);
    for (const auto& [name, step] : steps)
    {
        step(stock);
        step(scene);
        const osg::ref_ptr<osg::Image> expected = lit::picture(*stock.root, 1);
        const osg::ref_ptr<osg::Image> actual = lit::picture(*scene.root, 1);
        EXPECT_TRUE(support::CompareImage()(actual, expected, std::string("lit.change.") + name));
        EXPECT_TRUE(lit::differ(*expected, *before)) << name << " changes nothing";
        before = expected;
    }
    lit::planOf(*kit);
}

TEST_F(LitSceneState, theModelIsBitForBitAsLoaded)
{
    for (const char* file : {"chess/king.iv", "simple/texture.iv"})
    {
        osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(support::inventorModel(file));
        ASSERT_TRUE(model.valid());
        // The viewer itself marks what is static in a scene that it gets.
        lit::picture(*model, 1);
        for (Lighting lighting : {Lighting::PIXEL, Lighting::VERTEX, Lighting::OFF})
        {
            const std::string before = saved(*model);
            osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lighting);
            kit->addChild(model);
            lit::viewer().render(kit, support::CameraSpec::overview(*kit, 4.0 / 3.0), lit::Width,
                                 lit::Height, 3);
            const std::string after = saved(*model);
            EXPECT_TRUE(after == before) << file << firstDifference(after, before);
            EXPECT_GT(before.size(), 1000u);
        }
    }
}

TEST_F(LitSceneState, aSceneThatUsesNothingGetsNothing)
{
    lit::viewer().getViewer().setLightingMode(osg::View::NO_LIGHT);
    osg::ref_ptr<ObjectCount> count = new ObjectCount;
    osg::Camera& camera = *lit::viewer().getViewer().getCamera();
    camera.setPostDrawCallback(count);
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    kit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(-1, 0, -1), osg::Vec3(2, 0, 0),
                                                       osg::Vec3(0, 0, 2)));
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    plain->addChild(geode);
    lit::picture(*plain);
    const unsigned int programs = count->programs, textures = count->textures;
    kit->addChild(geode);
    lit::picture(*kit);
    const osgMultiRender::Plan plan = lit::planOf(*kit);
    EXPECT_NE(lit::entryOf(plan, "variant plain"), "");
    EXPECT_EQ(plan.counts.at("variants"), 1.0);
    EXPECT_EQ(plan.counts.at("passes"), 1.0);
    EXPECT_EQ(plan.counts.at("lights.drawn"), 0.0);
    EXPECT_EQ(plan.counts.at("textureBytes"), 0.0);
    EXPECT_LE(count->programs, programs + 1) << "the plain program";
    EXPECT_EQ(count->textures, textures);
    // Lit, with no light at all: ambient light alone, and still no texture.
    kit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    lit::picture(*kit);
    EXPECT_EQ(lit::planOf(*kit).counts.at("textureBytes"), 0.0);
    EXPECT_EQ(lit::planOf(*kit).counts.at("lights.drawn"), 0.0);
    EXPECT_LE(count->programs, programs + 2);
    EXPECT_EQ(count->textures, textures);
    camera.setPostDrawCallback(nullptr);
    lit::viewer().getViewer().setLightingMode(osg::View::HEADLIGHT);
}

TEST_F(LitSceneState, theHeadlightNoLightAndTheSkylightAreThoseOfTheView)
{
    for (auto mode : {osg::View::HEADLIGHT, osg::View::NO_LIGHT, osg::View::SKY_LIGHT})
    {
        lit::viewer().getViewer().setLightingMode(mode);
        expectSameAsStock(
            [](osg::Group& kit)
            {
                kit.addChild(ball({0, 0, 0}));
                return osg::ref_ptr<osg::Node>(&kit);
            },
            "lit.viewLight" + std::to_string(mode));
    }
    lit::viewer().getViewer().setLightingMode(osg::View::HEADLIGHT);
}

TEST_F(LitSceneState, lightsAreScopedByTheirModes)
{
    const auto build = [](unsigned int firstNumber, unsigned int secondNumber)
    {
        return [=](osg::Group& kit)
        {
            osg::ref_ptr<osg::Geode> left = ball({-0.9f, 0, 0}), right = ball({0.9f, 0, 0});
            kit.addChild(lightSource(firstNumber, osg::Vec4(-1, -1, 1, 0), osg::Vec4(1, 0, 0, 1),
                                     *left->getOrCreateStateSet()));
            kit.addChild(lightSource(secondNumber, osg::Vec4(1, -1, 0, 0), osg::Vec4(0, 0.4f, 1, 1),
                                     *right->getOrCreateStateSet()));
            kit.addChild(left);
            kit.addChild(right);
            kit.getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
            return osg::ref_ptr<osg::Node>(&kit);
        };
    };
    expectSameAsStock(build(3, 5), "lit.scope");
    // The same picture with a number that GL does not have.
    osg::ref_ptr<osgShadowVolume::LitScene> low = lit::litScene(Lighting::PIXEL);
    osg::ref_ptr<osgShadowVolume::LitScene> high = lit::litScene(Lighting::PIXEL);
    const osg::ref_ptr<osg::Image> expected = lit::picture(*build(3, 5)(*low));
    const osg::ref_ptr<osg::Image> actual = lit::picture(*build(3, 12)(*high));
    EXPECT_TRUE(support::CompareImage()(actual, expected, "lit.scope12"));
    EXPECT_EQ(lit::planOf(*high).counts.at("lights.drawn"), 2.0);
}

TEST_F(LitSceneState, ofTwoLightSourcesWithOneNumberTheLastCounts)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            kit.addChild(lightSource(2, osg::Vec4(-1, -1, 1, 0), osg::Vec4(1, 0, 0, 1),
                                     *kit.getOrCreateStateSet()));
            kit.addChild(ball({-0.9f, 0, 0}));
            kit.addChild(lightSource(2, osg::Vec4(1, -1, 1, 0), osg::Vec4(0, 1, 0, 1),
                                     *kit.getOrCreateStateSet()));
            kit.addChild(ball({0.9f, 0, 0}));
            return osg::ref_ptr<osg::Node>(&kit);
        },
        "lit.sameNumber");
}

TEST_F(LitSceneState, lightsAboveSevenRaiseNoErrorWhereverTheyAre)
{
    // HeadlessViewer fails the test on GL errors. Stock OSG raises GL_INVALID_ENUM for these.
    for (Lighting lighting : {Lighting::PIXEL, Lighting::VERTEX, Lighting::OFF})
    {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lighting);
        osg::StateSet& scope = *kit->getOrCreateStateSet();
        const osg::Vec4 position(1, -1, 1, 0), color(0.3f, 0.3f, 0.3f, 1);
        root->addChild(lightSource(8, position, color, scope)); // before the group
        kit->addChild(lightSource(9, position, color, scope));  // in it
        kit->addChild(lightSource(100, position, color, scope));
        kit->addChild(ball({0, 0, 0}));
        lit::makeTransparent(*kit->getChild(2));
        kit->addChild(ball({0.9f, 0, 0}));
        root->addChild(kit);
        root->addChild(lightSource(10, position, color, scope)); // after it
        root->addChild(ball({-0.9f, 0, 0}));
        EXPECT_TRUE(lit::picture(*root, 3).valid());
        const osgMultiRender::Plan plan = lit::planOf(*kit);
        if (lighting == Lighting::PIXEL)
        {
            for (const char* light : {"light 8", "light 9", "light 10 ", "light 100"})
                EXPECT_EQ(lit::entryOf(plan, light),
                          "folded: in the one pass of all unshadowed lights");
        }
        else
        {
            EXPECT_NE(lit::entryOf(plan, "light 9").find("dropped: "), std::string::npos);
        }
    }
}

TEST_F(LitSceneState, lightsThatReachNothingCostNothingAndAreNamed)
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    osg::StateSet& scope = *kit->getOrCreateStateSet();
    kit->addChild(ball({-0.9f, 0, 0}));
    kit->addChild(ball({0.9f, 0, 0}));
    kit->addChild(lightSource(1, osg::Vec4(1, -1, 1, 0), osg::Vec4(0.5f, 0.5f, 0.5f, 1), scope));
    const osg::ref_ptr<osg::Image> before = lit::picture(*kit);
    const osgMultiRender::Plan plan = lit::planOf(*kit);

    const auto add = [&](unsigned int number, const osg::Vec4& position, const osg::Vec4& color)
    {
        osg::ref_ptr<osg::Node> source = lightSource(number, position, color, scope);
        kit->addChild(source);
        return static_cast<osg::LightSource*>(source.get())->getLight();
    };
    add(2, osg::Vec4(0, 0, 500, 1), osg::Vec4(1, 1, 1, 1))->setQuadraticAttenuation(1.0f);
    osg::Light* spot = add(3, osg::Vec4(0, 0, 5, 1), osg::Vec4(1, 1, 1, 1));
    spot->setDirection(osg::Vec3(0, 0, 1));
    spot->setSpotCutoff(40.0f);
    add(4, osg::Vec4(0, -2, 2, 1), osg::Vec4(0, 0, 0, 1));
    add(20, osg::Vec4(0, 900, 0, 1), osg::Vec4(1, 1, 1, 1))->setLinearAttenuation(100.0f);
    add(5, osg::Vec4(NAN, 0, 0, 1), osg::Vec4(1, 1, 1, 1));
    const osg::ref_ptr<osg::Image> after = lit::picture(*kit);
    const osgMultiRender::Plan more = lit::planOf(*kit);

    EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(after, before, "lit.lightsForNothing")));
    for (const char* count : {"drawCalls", "passes", "variants", "lights.drawn", "textureBytes"})
        EXPECT_EQ(more.counts.at(count), plan.counts.at(count)) << count;
    EXPECT_EQ(more.counts.at("programs.compiled"), plan.counts.at("programs.compiled"));
    EXPECT_EQ(more.counts.at("lights.dropped"), plan.counts.at("lights.dropped") + 5.0);
    for (const char* light : {"light 2 ", "light 3 ", "light 20 "})
        EXPECT_EQ(lit::entryOf(more, light), "dropped: it reaches nothing in view");
    EXPECT_EQ(lit::entryOf(more, "light 4 "), "dropped: it is black");
    EXPECT_EQ(lit::entryOf(more, "light 5 "),
              "dropped: a parameter of it is infinite or not a number");
}

TEST_F(LitSceneState, aLightWhoseModeIsOffIsDroppedByName)
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    osg::ref_ptr<osg::StateSet> nowhere = new osg::StateSet;
    kit->addChild(lightSource(6, osg::Vec4(1, -1, 1, 0), osg::Vec4(1, 1, 1, 1), *nowhere));
    kit->addChild(ball({0, 0, 0}));
    lit::picture(*kit);
    EXPECT_EQ(lit::entryOf(lit::planOf(*kit), "light 6 "),
              "dropped: no drawable in view has it on and in reach");
}
