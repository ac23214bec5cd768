// SPDX-License-Identifier: MIT
#include <support/NotifyCapture.h>
#include <support/SettingsPage.h>
#include <support/TemporaryFolder.h>

#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixFile.h>
#include <osgMultiRender/MixOptions.h>
#include <osgMultiRender/MixedScene.h>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <cmath>

using namespace osgMultiRender;

namespace
{

using Lines = std::vector<std::string>;

constexpr double Infinity = std::numeric_limits<double>::infinity();

const char* const Street = R"({
  // the street and what is around it
  "renderings": [
    { "name": "phong", "range": [0, 0, 4, 6], "uniforms": { "gloss": 60 } },
    { "file": "own.frag", "range": [4, 6] }
  ],
  "points": [[0, 0, 1], [8, 0, 1]],
  "mode": "polyline",
  "base": "phong",
  "excess": "normalise",
  "background": "#ff8000",
  "settle": 3,
  "show": "lines",
  "pruning": false
})";

/// "" or the error.
std::string apply(const std::string& text)
{
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    scene->addRendering(importNamed("toon"));
    const std::string before = formatMix(*scene);
    std::string error;
    const bool ok = applyMix(*scene, text, "a.mix", error);
    EXPECT_EQ(ok, error.empty());
    EXPECT_EQ(formatMix(*scene) == before, !ok || text == "{}") << text;
    return error;
}

} // namespace

TEST(MixFileTest, aMixSaysAllOfIt)
{
    const support::TemporaryFolder folder;
    folder.write("own.frag", "uniform float a; // = 3\nvoid main() { gl_FragColor = "
                             "vec4(a); }\n");
    folder.write("street.mix", Street);
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    std::string error;
    ASSERT_TRUE(readMixFile(*scene, folder.file("street.mix"), error)) << error;
    ASSERT_EQ(scene->getRenderings(), (std::vector<unsigned int>{0, 1}));
    EXPECT_EQ(scene->getRendering(1)->name, "own");
    EXPECT_TRUE(scene->getRendering(1)->ok());
    EXPECT_EQ(scene->getUniform(0, "gloss"), std::vector<double>{60});
    EXPECT_EQ(scene->getUniform(0, "highlight"), std::vector<double>{0.5}) << "the built-in value";
    EXPECT_EQ(scene->getUniform(1, "a"), std::vector<double>{3});
    EXPECT_EQ(scene->getRange(0).dr3, 6);
    EXPECT_EQ(scene->getRange(1).dr0, 4);
    EXPECT_EQ(scene->getRange(1).dr2, Infinity);
    EXPECT_EQ(scene->getKeyPoints().size(), 2u);
    EXPECT_EQ(scene->getKeyMode(), KeyMode::Polyline);
    EXPECT_EQ(scene->getRules().base, 0);
    EXPECT_EQ(scene->getRules().excess, MixRules::Excess::Normalise);
    EXPECT_NEAR(scene->getRules().background.g, 128.0 / 255.0, 1e-9);
    EXPECT_EQ(scene->getSettleFrames(), 3u);
    EXPECT_EQ(scene->getMarks(), MixMarks::Lines);
    EXPECT_FALSE(scene->getPruning());
}

TEST(MixFileTest, textsAndFilesHoldTheWholeMix)
{
    const support::TemporaryFolder folder;
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    std::string error;
    ASSERT_TRUE(applyMix(*scene,
                         R"({"renderings": [{"name": "toon"}, {"name": "phong",
                             "range": [1, 2, 3, "inf"], "uniforms": {"gloss": 7}},
                             {"name": "mine", "fragment": "void main() { gl_FragColor = vec4(1); }"}],
                             "points": [[1e7, 0.1, -3]], "mode": "loop", "base": 1,
                             "background": "transparent", "lighting": "own", "programs": 5, "keys": false})",
                         "", error))
        << error;
    scene->removeRendering(0); // numbers of a text have no gaps
    const std::string text = scene->getMixText();
    const osg::ref_ptr<MixedScene> other = new MixedScene;
    other->setMixText(text);
    EXPECT_EQ(other->getMixText(), text);
    EXPECT_EQ(other->getRules().base, 0);
    EXPECT_TRUE(other->getOwnLighting());
    EXPECT_EQ(other->getUniform(0, "gloss"), std::vector<double>{7});
    EXPECT_EQ(other->getRendering(1)->name, "mine");
    for (const char* const format : {"osgt", "osgb", "osgx"})
    {
        const std::string file = folder.file(std::string("scene.") + format);
        ASSERT_TRUE(osgDB::writeNodeFile(*other, file)) << format;
        const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(file);
        auto* mixed = dynamic_cast<MixedScene*>(read.get());
        ASSERT_TRUE(mixed) << format;
        EXPECT_EQ(mixed->getMixText(), text) << format;
    }
}

TEST(MixFileTest, whatIsWrongIsOneLineAndChangesNothing)
{
    EXPECT_EQ(apply("{\"points\": [[0, 0, 0]]}"), "");
    EXPECT_NE(apply("{\n\"points\": [[0, 0, 0]\n").find("a.mix: line "), std::string::npos);
    EXPECT_EQ(apply("[]"), "a.mix: the mix is no object; write { \"renderings\": […], … }");
    EXPECT_EQ(apply("{\"points\": [[0, 0]]}"), "a.mix: points[0] is not three numbers");
    EXPECT_EQ(apply("{\"renderings\": [{\"name\": \"tune\"}]}"),
              "a.mix: renderings[0] names 'tune', which is not built in; say it as a file");
    EXPECT_EQ(apply("{\"renderings\": [{\"name\": \"toon\", \"range\": [1, 2, 3, 4, 5]}]}"),
              "a.mix: renderings[0].range: a range is one to four distances, dr0, dr1, dr2, dr3");
    EXPECT_EQ(apply("{\"point\": 3}"), "a.mix: 'point' is not known; see docs/settings.md");
    EXPECT_EQ(apply("{\"mode\": \"line\"}"), "a.mix: setting 'mode=line': 'line' is none of "
                                             "points, polyline, loop");
    EXPECT_EQ(apply("{\"base\": \"phong\"}"),
              "a.mix: setting 'base=phong': there is no rendering 'phong'; name one, its number or "
              "'none'");
    EXPECT_EQ(apply("{\"points\": [[0, 0, 1e999]]}").find("a.mix: the mix is no JSON; "), 0u);
    for (const int depth : {17, 1000000}) // closed, and broken off
        for (const std::string& end : {std::string(std::size_t(depth), ']') + "}", std::string()})
        {
            const std::string said =
                apply("{\"points\": " + std::string(std::size_t(depth), '[') + end);
            EXPECT_EQ(said.find("a.mix: "), 0u);
            EXPECT_EQ(said.find('\n'), std::string::npos);
        }
    std::string error;
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    EXPECT_FALSE(readMixFile(*scene, "missing.mix", error));
    EXPECT_EQ(error.find("missing.mix: "), 0u) << error;
}

TEST(MixFileTest, eachOptionTakesWhatItGives)
{
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    std::string error;
    ASSERT_TRUE(setMixOptions(*scene,
                              {{"renderings", "phong:0,0,1,3;toon:1,3"},
                               {"points", "0,0,0;1,2,3"},
                               {"mode", "loop"},
                               {"base", "toon"},
                               {"background", "#01020304"},
                               {"uniforms", "phong.gloss=9;1.tones=4"},
                               {"settle", "0"},
                               {"programs", "3"},
                               {"show", "points"},
                               {"keys", "off"}},
                              error))
        << error;
    EXPECT_EQ(scene->getUniform(0, "gloss"), std::vector<double>{9});
    EXPECT_EQ(scene->getUniform(1, "tones"), std::vector<double>{4});
    const osg::ref_ptr<MixedScene> other = new MixedScene;
    for (const MixOption& option : mixOptions())
        if (const std::string text = option.format(*scene); !text.empty())
        {
            EXPECT_EQ(option.parse(*other, text), "") << option.name;
            EXPECT_EQ(option.format(*other), text) << option.name;
        }
    EXPECT_FALSE(setMixOptions(*scene, {{"uniforms", "phong.glos=9"}}, error));
    EXPECT_EQ(error, "setting 'uniforms=phong.glos=9': rendering 'phong' has no uniform 'glos'");
}

TEST(MixFileTest, eachOptionIsDocumented)
{
    const osg::ref_ptr<MixedScene> defaults = new MixedScene;
    std::vector<support::DocumentedSetting> settings;
    for (const MixOption& option : mixOptions())
        settings.push_back({option.name, option.values, option.format(*defaults)});
    EXPECT_EQ(support::undocumented(OSGKITS_SETTINGS_PAGE, "## Renderings", settings), Lines());
}

TEST(MixFileTest, aBaseByNumberIsThePlaceInItsOwnMix)
{
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    for (const char* const name : {"phong", "toon", "wood"})
        scene->addRendering(importNamed(name));
    std::string error;
    ASSERT_TRUE(applyMix(*scene, R"({"renderings": [{"name": "gooch"}, {"name": "xray"}],
                                     "base": "1"})",
                         {}, error))
        << error;
    EXPECT_EQ(scene->getRules().base, 4);
}

TEST(MixFileTest, textsThatAreNotUtf8AndInfiniteUniformsAreWritten)
{
    Rendering rendering = importNamed("phong");
    rendering.name = "gl\xe4nzend";
    const osg::ref_ptr<MixedScene> scene = new MixedScene, other = new MixedScene;
    scene->addRendering(rendering);
    scene->setUniform(0, "gloss", {std::numeric_limits<double>::infinity()});
    std::string text, error;
    ASSERT_NO_THROW(text = scene->getMixText());
    EXPECT_TRUE(applyMix(*other, text, {}, error)) << error;
    EXPECT_EQ(other->getUniform(0, "gloss"),
              std::vector<double>{std::numeric_limits<double>::infinity()});
}

TEST(MixFileTest, aProgramInFullKeepsAllThatItIsMadeOf)
{
    Rendering own;
    own.name = "own";
    own.shaders = {
        {GlslStage::Vertex,
         "attribute vec3 wind;\nvoid main() { gl_Position = "
         "ftransform() + vec4(wind, 0.0); }\n",
         "a"},
        {GlslStage::Fragment, "vec4 tint();\nvoid main() { gl_FragColor = tint(); }\n", "b"},
        {GlslStage::Fragment,
         "uniform sampler2D map; uniform float gain;\nvec4 tint() { "
         "return gain * texture2D(map, vec2(STEPS)); }\n",
         "c"}};
    own.defines["STEPS"] = "8";
    own.attributeBindings["wind"] = 6;
    own.fragmentDataBindings["color"] = 0;
    RenderingTexture texture;
    texture.unit = 3;
    texture.fileName = "/pictures/map.png";
    texture.wrap = {0x812F, 0x812F, 0x2901};
    own.textures.push_back(texture);
    RenderingUniform map;
    map.name = "map";
    map.values = {3};
    own.uniforms.push_back(map);
    const osg::ref_ptr<MixedScene> scene = new MixedScene, other = new MixedScene;
    scene->addRendering(own);
    scene->setUniform(0, "gain", {0.5}); // which the rendering does not list
    std::string error;
    support::NotifyCapture capture;
    ASSERT_TRUE(applyMix(*other, formatMix(*scene), {}, error)) << error;
    EXPECT_EQ(capture.takeWarnings(), Lines());
    const Rendering& read = *other->getRendering(0);
    ASSERT_EQ(read.shaders.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
    {
        EXPECT_EQ(read.shaders[i].text, own.shaders[i].text);
        EXPECT_EQ(read.shaders[i].stage, own.shaders[i].stage);
    }
    EXPECT_EQ(read.defines, own.defines);
    EXPECT_EQ(read.attributeBindings, own.attributeBindings);
    EXPECT_EQ(read.fragmentDataBindings, own.fragmentDataBindings);
    ASSERT_EQ(read.textures.size(), 1u);
    EXPECT_EQ(read.textures[0].fileName, texture.fileName);
    EXPECT_EQ(read.textures[0].unit, 3u);
    EXPECT_EQ(read.textures[0].wrap, texture.wrap);
    ASSERT_TRUE(read.findUniform("map"));
    EXPECT_EQ(read.findUniform("map")->values, std::vector<double>{3});
    EXPECT_EQ(other->getUniform(0, "gain"), std::vector<double>{0.5});
    own.state.given = true;
    scene->setRendering(0, own);
    formatMix(*scene);
    const Lines warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'own' is not saved as a whole"), std::string::npos);
}

TEST(MixFileTest, aProgramInFullThatIsWrongIsOneLine)
{
    const auto inFull = [](const std::string& rest)
    { return apply(R"({"renderings": [{"fragment": "void main() {}", )" + rest + "}]}"); };
    const std::string place = "a.mix: renderings[0]";
    EXPECT_EQ(inFull(R"("vertex": [3])"), place + ".vertex is no text");
    EXPECT_EQ(inFull(R"("defines": {"A": 3})"), place + ".defines.A is no text");
    EXPECT_EQ(inFull(R"("attributes": {"a": -1})"), place + ".attributes.a is no number");
    EXPECT_EQ(inFull(R"("textures": [{"file": 3}])"), place + ".textures[0].file is no text");
    EXPECT_EQ(inFull(R"("textures": [{"unit": 3}])").find(place + ".textures[0] is no texture"),
              0u);
    EXPECT_EQ(inFull(R"("textures": [{"file": "a.png", "wrap": [1]}])")
                  .find(place + ".textures[0].wrap is none"),
              0u);
}
