// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceKey.h>
#include <osgMultiRender/SurfaceSource.h>

#include <osg/ClipPlane>
#include <osg/Fog>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/Point>
#include <osg/PointSprite>
#include <osg/ShadeModel>
#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture2D>
#include <osg/Texture3D>
#include <osg/TextureCubeMap>

#include <gtest/gtest.h>

#include <functional>
#include <set>

using namespace osgMultiRender;

namespace
{

using Change = std::function<void(osg::StateSet&)>;

osg::ref_ptr<osg::Image> image(GLenum format = GL_RGB)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, format, GL_UNSIGNED_BYTE);
    return image;
}

osg::ref_ptr<osg::Texture2D> texture(GLenum format = GL_RGB)
{
    return new osg::Texture2D(image(format));
}

/// Keeps the StateSets alive to which a key's state points while it is made.
std::string keyOf(const Change& change, SurfaceKey& key,
                  LightingMode lighting = LightingMode::Vertex, const GLLights& lights = GLLights())
{
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    change(*stateSet);
    SurfaceState state;
    state.apply(*stateSet);
    return makeSurfaceKey(state, lighting, lights, 0, key);
}

SurfaceKey keyOf(const Change& change, LightingMode lighting = LightingMode::Vertex)
{
    SurfaceKey key;
    EXPECT_EQ(keyOf(change, key, lighting), "");
    return key;
}

void lit(osg::StateSet& s)
{
    s.setMode(GL_LIGHTING, osg::StateAttribute::ON);
}

bool mentions(const SurfaceSource& source, const std::string& word)
{
    // Definitions that no define switches on are in the text too: look at the defines and at what
    // is generated.
    return (source.vertex + source.fragment).find(word) != std::string::npos;
}

void shiny(osg::StateSet& s)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
    s.setAttribute(material);
}

struct Feature
{
    const char* words;
    Change change;
};

/// Each feature and the words that it alone adds to a plain lit key.
std::vector<Feature> features()
{
    const auto on = osg::StateAttribute::ON;
    return {
        {"light0=directional", [=](auto& s) { s.setMode(GL_LIGHT0, on); }},
        {"light7=directional", [=](auto& s) { s.setMode(GL_LIGHT7, on); }},
        {"normalize", [=](auto& s) { s.setMode(GL_NORMALIZE, on); }},
        {"rescale", [=](auto& s) { s.setMode(GL_RESCALE_NORMAL, on); }},
        {"two-sided",
         [](auto& s)
         {
             osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
             model->setTwoSided(true);
             s.setAttribute(model);
         }},
        {"specular", shiny},
        {"local-viewer specular",
         [](auto& s)
         {
             shiny(s);
             osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
             model->setLocalViewer(true);
             s.setAttribute(model);
         }},
        {"separate-specular",
         [](auto& s)
         {
             shiny(s);
             osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
             model->setColorControl(osg::LightModel::SEPARATE_SPECULAR_COLOR);
             s.setAttribute(model);
         }},
        {"color=diffuse",
         [](auto& s)
         {
             osg::ref_ptr<osg::Material> material = new osg::Material;
             material->setColorMode(osg::Material::DIFFUSE);
             s.setAttribute(material);
         }},
        {"tex0=2D/modulate/RGB", [=](auto& s) { s.setTextureAttributeAndModes(0, texture(), on); }},
        {"tex3=2D/modulate/RGBA",
         [=](auto& s) { s.setTextureAttributeAndModes(3, texture(GL_RGBA), on); }},
        {"tex1=2D/replace/A",
         [=](auto& s)
         {
             s.setTextureAttributeAndModes(1, texture(GL_ALPHA), on);
             s.setTextureAttribute(1, new osg::TexEnv(osg::TexEnv::REPLACE));
         }},
        {"tex0=2D/modulate/RGB/gen-sphere",
         [=](auto& s)
         {
             s.setTextureAttributeAndModes(0, texture(), on);
             osg::ref_ptr<osg::TexGen> texGen = new osg::TexGen;
             texGen->setMode(osg::TexGen::SPHERE_MAP);
             s.setTextureAttributeAndModes(0, texGen, on);
         }},
        {"tex0=2D/modulate/RGB/matrix",
         [=](auto& s)
         {
             s.setTextureAttributeAndModes(0, texture(), on);
             s.setTextureAttribute(0, new osg::TexMat(osg::Matrix::scale(2, 2, 2)));
         }},
        {"fog=linear",
         [=](auto& s)
         {
             osg::ref_ptr<osg::Fog> fog = new osg::Fog;
             fog->setMode(osg::Fog::LINEAR);
             s.setAttributeAndModes(fog, on);
         }},
        {"fog=exp2/coordinate",
         [=](auto& s)
         {
             osg::ref_ptr<osg::Fog> fog = new osg::Fog;
             fog->setMode(osg::Fog::EXP2);
             fog->setFogCoordinateSource(osg::Fog::FOG_COORDINATE);
             s.setAttributeAndModes(fog, on);
         }},
        {"clip", [=](auto& s) { s.setAttributeAndModes(new osg::ClipPlane(3), on); }},
    };
}

} // namespace

TEST(SurfaceKey, aStateThatUsesNothingHasTheDefaultKeyAndAnEmptyProgram)
{
    for (LightingMode lighting : {LightingMode::Off, LightingMode::Vertex, LightingMode::Pixel})
    {
        const SurfaceKey key = keyOf([](auto&) {}, lighting);
        EXPECT_EQ(key, SurfaceKey());
        EXPECT_EQ(toString(key), "plain");
        const SurfaceSource source = makeSurfaceSource(key);
        for (const char* word : {"#define OSGMR_LIGHTING", "#define OSGMR_EYE",
                                 "#define OSGMR_NORMALS", "#define OSGMR_FOG", "#define OSGMR_CLIP",
                                 "#define OSGMR_TWO", "uniform", "sampler", "gl_MultiTexCoord"})
            EXPECT_FALSE(mentions(source, word)) << word;
    }
}

TEST(SurfaceKey, whatIsSetButOffOrUnreadLeavesThePlainKey)
{
    const auto on = osg::StateAttribute::ON, off = osg::StateAttribute::OFF;
    const std::vector<Change> idle = {
        [=](auto& s) { s.setMode(GL_LIGHT0, on); }, // without GL_LIGHTING
        [](auto& s) { s.setAttribute(new osg::Material); },
        [](auto& s) { s.setAttribute(new osg::LightModel); },
        [=](auto& s) { s.setAttributeAndModes(new osg::Fog, off); },
        [=](auto& s) { s.setTextureAttributeAndModes(0, texture(), off); },
        [=](auto& s) { s.setTextureMode(0, GL_TEXTURE_2D, on); },                   // no texture
        [=](auto& s) { s.setTextureAttributeAndModes(0, new osg::Texture2D, on); }, // no image
        [=](auto& s) { s.setTextureAttribute(0, texture()); },                      // no mode
        [=](auto& s) { // a mode of another target
            s.setTextureAttribute(0, texture());
            s.setTextureMode(0, GL_TEXTURE_3D, on);
        },
        [=](auto& s) { s.setTextureMode(0, GL_TEXTURE_GEN_S, on); },
        [](auto& s) { s.setTextureAttribute(0, new osg::TexMat(osg::Matrix::scale(2, 2, 2))); },
        [=](auto& s) { s.setMode(GL_NORMALIZE, on); },
        [=](auto& s) { s.setMode(GL_BLEND, on); },
        [](auto& s) { s.setAttribute(new osg::ShadeModel(osg::ShadeModel::FLAT)); },
    };
    for (std::size_t i = 0; i < idle.size(); ++i)
        EXPECT_EQ(toString(keyOf(idle[i])), "plain") << "case " << i;
    SurfaceKey key;
    EXPECT_EQ(keyOf(lit, key, LightingMode::Off), "");
    EXPECT_EQ(key, SurfaceKey()) << "lighting=off leaves lit states plain";
}

TEST(SurfaceKey, eachFeatureAddsItsOwnWordsAndNoOther)
{
    EXPECT_EQ(toString(keyOf(lit)), "lighting=vertex");
    for (const Feature& feature : features())
        EXPECT_EQ(toString(keyOf(
                      [&](osg::StateSet& s)
                      {
                          lit(s);
                          feature.change(s);
                      })),
                  std::string("lighting=vertex ") + feature.words);
}

TEST(SurfaceKey, pixelLightingLeavesTheTypesOfLightsToTheKit)
{
    const SurfaceKey key = keyOf(
        [](osg::StateSet& s)
        {
            lit(s);
            s.setMode(GL_LIGHT0, osg::StateAttribute::ON);
            s.setAttribute(new osg::ShadeModel(osg::ShadeModel::FLAT));
        },
        LightingMode::Pixel);
    EXPECT_EQ(toString(key), "lighting=pixel flat");
}

TEST(SurfaceKey, lightsHaveTheTypeOfTheStateSetsElseOfThePositionedOne)
{
    osg::ref_ptr<osg::Light> point = new osg::Light(1), spot = new osg::Light(2);
    point->setPosition(osg::Vec4(0, 0, 1, 1));
    spot->setPosition(osg::Vec4(0, 0, 1, 1));
    spot->setSpotCutoff(30.0f);
    GLLights positioned{};
    positioned[1] = point;
    positioned[2] = spot;
    SurfaceKey key;
    keyOf(
        [&](osg::StateSet& s)
        {
            lit(s);
            for (unsigned int i = 0; i < 3; ++i)
                s.setMode(GL_LIGHT0 + i, osg::StateAttribute::ON);
            osg::ref_ptr<osg::Light> own = new osg::Light(1);
            own->setPosition(osg::Vec4(0, 0, 1, 0));
            s.setAttribute(own);
        },
        key, LightingMode::Vertex, positioned);
    EXPECT_EQ(toString(key), "lighting=vertex light0=directional light1=directional light2=spot");
}

TEST(SurfaceKey, equalKeysHashEquallyAndDifferentOnesHardlyEver)
{
    const std::vector<Feature> all = features();
    std::set<std::size_t> hashes;
    std::vector<SurfaceKey> keys;
    for (unsigned int set = 0; set < 1u << 12; ++set)
    {
        const Change change = [&](osg::StateSet& s)
        {
            lit(s);
            for (std::size_t i = 0; i < 12; ++i)
                if (set & (1u << i))
                    all[i].change(s);
        };
        const SurfaceKey key = keyOf(change), again = keyOf(change);
        ASSERT_EQ(key, again);
        ASSERT_EQ(SurfaceKeyHash()(key), SurfaceKeyHash()(again));
        hashes.insert(SurfaceKeyHash()(key));
        keys.push_back(key);
    }
    std::set<std::string> words;
    for (const SurfaceKey& key : keys)
        words.insert(toString(key));
    // normalize wins over rescale, and several of the features set the same LightModel: keys are
    // fewer than sets of features, but words, keys and hashes tell the same ones apart.
    EXPECT_EQ(hashes.size(), words.size());
    EXPECT_GT(words.size(), 500u);
}

TEST(SurfaceKey, whatACombinerDoesNotReadDoesNotSplitVariants)
{
    const auto combine = [](GLint unread)
    {
        return [unread](osg::StateSet& s)
        {
            s.setTextureAttributeAndModes(0, texture(), osg::StateAttribute::ON);
            osg::ref_ptr<osg::TexEnvCombine> env = new osg::TexEnvCombine;
            env->setCombine_RGB(osg::TexEnvCombine::REPLACE);
            env->setCombine_Alpha(osg::TexEnvCombine::REPLACE);
            env->setSource2_RGB(unread);
            s.setTextureAttribute(0, env);
        };
    };
    EXPECT_EQ(keyOf(combine(osg::TexEnvCombine::CONSTANT)),
              keyOf(combine(osg::TexEnvCombine::PREVIOUS)));
}

TEST(SurfaceKey, whatIsBeyondTheSurfaceFunctionsIsNamed)
{
    const auto on = osg::StateAttribute::ON;
    SurfaceKey key;
    EXPECT_EQ(keyOf([=](auto& s) { s.setTextureAttributeAndModes(4, texture(), on); }, key),
              "a texture unit above 3");
    EXPECT_EQ(
        keyOf([=](auto& s) { s.setTextureAttributeAndModes(0, new osg::PointSprite, on); }, key),
        "point sprites");
    EXPECT_EQ(keyOf(
                  [](auto& s)
                  {
                      osg::ref_ptr<osg::Point> point = new osg::Point;
                      point->setDistanceAttenuation(osg::Vec3(0, 0, 1));
                      s.setAttribute(point);
                  },
                  key),
              "distance attenuation of points");
    EXPECT_EQ(keyOf(
                  [=](auto& s)
                  {
                      osg::ref_ptr<osg::Texture2D> shadow = texture(GL_DEPTH_COMPONENT);
                      shadow->setShadowComparison(true);
                      s.setTextureAttributeAndModes(0, shadow, on);
                  },
                  key),
              "depth comparison of a texture");
    EXPECT_EQ(keyOf([=](auto& s) { s.setMode(GL_VERTEX_PROGRAM_ARB, on); }, key),
              "an ARB vertex or fragment program");
}

TEST(SurfaceKey, sourcesHaveTheSamplersAndLightsOfTheirKey)
{
    const SurfaceSource source = makeSurfaceSource(keyOf(
        [](osg::StateSet& s)
        {
            lit(s);
            s.setMode(GL_LIGHT0 + 3, osg::StateAttribute::ON);
            s.setTextureAttributeAndModes(2, texture(), osg::StateAttribute::ON);
        }));
    EXPECT_TRUE(mentions(source, "uniform sampler2D osgmr_texture2;"));
    EXPECT_FALSE(mentions(source, "osgmr_texture0"));
    EXPECT_TRUE(mentions(source, "osgmr_addLight(gl_LightSource[3]"));
    EXPECT_FALSE(mentions(source, "gl_LightSource[0]"));
}

TEST(SurfaceKey, versionsAreThoseOfTheContextFrom330To450)
{
    EXPECT_EQ(glslVersionLine(4.5f), "#version 450 compatibility\n");
    EXPECT_EQ(glslVersionLine(4.3f), "#version 430 compatibility\n");
    EXPECT_EQ(glslVersionLine(3.3f), "#version 330 compatibility\n");
    EXPECT_EQ(glslVersionLine(4.6f), "#version 450 compatibility\n");
    EXPECT_EQ(glslVersionLine(1.2f), "#version 330 compatibility\n");
}
