// SPDX-License-Identifier: MIT
#include <support/SettingsPage.h>

#include <osgShadowVolume/SceneOptions.h>

#include <gtest/gtest.h>

#include <map>

using namespace osgShadowVolume;

namespace
{

using Scene = osg::ref_ptr<ShadowedScene>;

/// A text for each option that is not its default.
const std::map<std::string, std::string> Changed = {{"shadows", "map"},
                                                    {"technique", "geometry"},
                                                    {"transparent", "none"},
                                                    {"headlight", "shadow"},
                                                    {"layers", "7"},
                                                    {"mapsize", "65536"},
                                                    {"pcf", "5"},
                                                    {"mapbudget", "17"},
                                                    {"show", "lux"},
                                                    {"light", "12"},
                                                    {"mirrors", "off"},
                                                    {"maxmirrors", "9"},
                                                    {"keys", "off"},
                                                    {"metres", "0.0254"},
                                                    {"maxlux", "1e+30"},
                                                    {"candela", "800"},
                                                    {"lux", "90000"},
                                                    {"lighting", "vertex"},
                                                    {"lights", "all"},
                                                    {"tolerance", "0.1"}};

std::string errorOf(const std::string& name, const std::string& text)
{
    const Scene scene = new ShadowedScene;
    std::string error;
    EXPECT_FALSE(setSceneOption(*scene, name, text, error)) << name << "=" << text;
    return error;
}

} // namespace

TEST(SceneOptionsTest, eachOptionSetsItsOwnAndSaysItAgain)
{
    ASSERT_EQ(sceneOptions().size(), Changed.size());
    for (const SceneOption& option : sceneOptions())
    {
        const Scene scene = new ShadowedScene, untouched = new ShadowedScene;
        EXPECT_NE(option.format(*scene), Changed.at(option.name));
        std::string error;
        EXPECT_TRUE(setSceneOption(*scene, option.name, Changed.at(option.name), error)) << error;
        for (const SceneOption& other : sceneOptions())
            EXPECT_EQ(other.format(*scene), other.name == option.name ? Changed.at(option.name)
                                                                      : other.format(*untouched))
                << option.name << " and " << other.name;
        EXPECT_EQ(option.parse(*untouched, option.format(*scene)), "");
        EXPECT_EQ(option.format(*untouched), option.format(*scene));
    }
}

TEST(SceneOptionsTest, settingsArriveInTheScene)
{
    const Scene scene = new ShadowedScene;
    std::string error;
    for (const auto& [name, text] : Changed)
        ASSERT_TRUE(setSceneOption(*scene, name, text, error)) << error;
    EXPECT_EQ(scene->getShadows(), Shadows::MAP);
    EXPECT_EQ(scene->getTechnique(), Technique::GEOMETRY);
    EXPECT_EQ(scene->getTransparentCasters(), TransparentCasters::NONE);
    EXPECT_TRUE(scene->getHeadlightShadow());
    EXPECT_EQ(scene->getTransparentLayers(), 7u);
    EXPECT_EQ(scene->getMapSize(), 65536u);
    EXPECT_EQ(scene->getMapSamples(), 5u);
    EXPECT_EQ(scene->getMapMegabytes(), 17u);
    EXPECT_EQ(scene->getShow(), Show::LUX);
    EXPECT_EQ(scene->getLightShown(), 12);
    EXPECT_FALSE(scene->getMirrors());
    EXPECT_EQ(scene->getMaxMirrors(), 9u);
    EXPECT_FALSE(scene->getKeys());
    EXPECT_EQ(scene->getMetresPerUnit(), 0.0254);
    EXPECT_EQ(scene->getIlluminanceMaximum(), 1e30);
    EXPECT_EQ(scene->getCandela(), 800.0);
    EXPECT_EQ(scene->getLux(), 90000.0);
    EXPECT_EQ(scene->getLighting(), LitScene::Lighting::VERTEX);
    EXPECT_EQ(scene->getLightScope(), LitScene::LightScope::ALL);
    EXPECT_EQ(scene->getLightTolerance(), 0.1);
    // A copy has them all.
    const Scene copy = new ShadowedScene(*scene);
    for (const SceneOption& option : sceneOptions())
        EXPECT_EQ(option.format(*copy), option.format(*scene)) << option.name;
}

TEST(SceneOptionsTest, opaqueIsAnotherWordForAllTransparentCasters)
{
    const Scene scene = new ShadowedScene;
    std::string error;
    EXPECT_TRUE(setSceneOption(*scene, "transparent", "opaque", error)) << error;
    EXPECT_EQ(scene->getTransparentCasters(), TransparentCasters::ALL);
}

TEST(SceneOptionsTest, wrongTextIsNamedWithWhatMayBeSaid)
{
    EXPECT_EQ(errorOf("shadows", "sharp"),
              "setting 'shadows=sharp': 'sharp' is none of volumes, map, off");
    EXPECT_EQ(errorOf("mapsize", "8"),
              "setting 'mapsize=8': '8' is not a whole number from 16 to 65536");
    EXPECT_EQ(errorOf("tolerance", "1.5"),
              "setting 'tolerance=1.5': '1.5' is not a number from 0 to 1");
    EXPECT_EQ(errorOf("metres", "-1"), "setting 'metres=-1': '-1' is not a number of at least 0");
    EXPECT_EQ(errorOf("light", "-2"),
              "setting 'light=-2': '-2' is neither all nor the number of a light, 0 or more");
    EXPECT_EQ(errorOf("shadow", "map").substr(0, 75),
              "setting 'shadow=map' is not known; there are shadows=volumes|map|off, techn");
}

TEST(SceneOptionsTest, noOptionTakesAnythingElse)
{
    ASSERT_FALSE(sceneOptions().empty());
    for (const SceneOption& option : sceneOptions())
        for (const char* text : {"", " ", "x", "1x", "0x10", "nan", "inf", "1e999", "-1", "1 2",
                                 "+1", "1,5", "Volumes", "all,"})
        {
            const Scene scene = new ShadowedScene;
            const std::string before = option.format(*scene);
            EXPECT_NE(option.parse(*scene, text), "") << option.name << "=" << text;
            EXPECT_EQ(option.format(*scene), before) << option.name << "=" << text;
        }
}

TEST(SceneOptionsTest, eachOptionIsDocumented)
{
    const Scene defaults = new ShadowedScene;
    std::vector<support::DocumentedSetting> settings;
    for (const SceneOption& option : sceneOptions())
        settings.push_back({option.name, option.values, option.format(*defaults)});
    EXPECT_EQ(support::undocumented(OSGKITS_SETTINGS_PAGE, "## Shadows", settings),
              std::vector<std::string>());
}
