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
                             "background": "transparent", "programs": 5, "keys": false})",
                         "", error))
        << error;
    scene->removeRendering(0); // numbers of a text have no gaps
    const std::string text = scene->getMixText();
    const osg::ref_ptr<MixedScene> other = new MixedScene;
    other->setMixText(text);
    EXPECT_EQ(other->getMixText(), text);
    EXPECT_EQ(other->getRules().base, 0);
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
