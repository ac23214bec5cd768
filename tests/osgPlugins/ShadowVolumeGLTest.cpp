// SPDX-License-Identifier: MIT
#include "StockPrograms.h"

#include <support/CompareImage.h>
#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <osgShadowVolume/SceneOptions.h>
#include <osgShadowVolume/ShadowKeys.h>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <filesystem>

namespace
{

using osgShadowVolume::ShadowedScene;

class ShadowVolumePlugin : public StockPrograms
{
protected:
    const std::string _king = support::inventorModel("chess/king.iv");
};

} // namespace

TEST_F(ShadowVolumePlugin, osgviewerLightsAModelBySuffix)
{
    const Picture stock = view(_king), pixel = view(_king + ".shadowvolume");
    const Picture vertex = view(_king + ".(lighting=vertex).shadowvolume");
    const Picture off = view(_king + ".(lighting=off).shadowvolume");
    ASSERT_TRUE(stock && pixel && vertex && off);
    EXPECT_TRUE(support::CompareImage()(vertex, stock, "plugin.vertex"));
    EXPECT_TRUE(differ(*off, *stock));
    EXPECT_TRUE(differ(*pixel, *off));
    // The option string says the same as parentheses, and these win.
    const Picture option =
        view(_king + ".shadowvolume", {}, {"--SingleThreaded", "-O", "shadowvolume.lighting=off"});
    EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(option, off, "plugin.option")));
    const Picture both = view(_king + ".(lighting=pixel).shadowvolume", {},
                              {"--SingleThreaded", "-O", "shadowvolume.lighting=off"});
    EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(both, pixel, "plugin.both")));
}

TEST_F(ShadowVolumePlugin, savedScenesLookTheSameWhenReadAgain)
{
    // With a texture, with transparency and with lights of the model's own.
    const std::string models[] = {_king, support::inventorModel("simple/texture.iv"),
                                  support::inventorModel("household/pump.iv")};
    for (std::size_t i = 0; i < std::size(models); ++i)
    {
        const std::string decorated = models[i] + ".(lights=all).shadowvolume";
        const Picture first = view(decorated);
        ASSERT_TRUE(first.valid());
        for (const char* extension : {"osgt", "osgb", "osgx", "osg"})
        {
            const std::string name = std::to_string(i) + "." + extension;
            const Picture second = view(convert(decorated, "saved" + name));
            // .osg itself loses images that have no file: there the kit must lose nothing more.
            const Picture expected =
                std::string(extension) == "osg"
                    ? view(convert(models[i], "plain" + name) + ".(lights=all).shadowvolume")
                    : first;
            EXPECT_TRUE((support::CompareImage{1.0 / 255.0, 0.001, 8.0 / 255.0}(
                second, expected, "plugin.saved" + name)));
        }
    }
}

TEST_F(ShadowVolumePlugin, settingsAreSavedInEachFormat)
{
    const Picture off = view(_king + ".(lighting=off).shadowvolume");
    const Picture pixel = view(_king + ".shadowvolume");
    ASSERT_TRUE(off && pixel && differ(*off, *pixel));
    for (const char* extension : {"osgt", "osgb", "osgx", "osg"})
    {
        const std::string saved =
            convert(_king + ".(lighting=off).shadowvolume", std::string("off.") + extension);
        EXPECT_TRUE(
            support::CompareImage()(view(saved), off, "plugin.off." + std::string(extension)));
        // There and back again: the formats do not eat each other's settings.
        const std::string back = convert(saved, std::string("back.") + extension + ".osgt");
        EXPECT_TRUE(
            support::CompareImage()(view(back), off, "plugin.back." + std::string(extension)));
    }
}

TEST_F(ShadowVolumePlugin, iveHoldsTheModelWithoutTheKit)
{
    const std::string saved = convert(_king + ".(lighting=off).shadowvolume", "flat.ive");
    const Picture flat = view(saved), stock = view(_king);
    ASSERT_TRUE(flat && stock);
    EXPECT_TRUE(support::CompareImage()(flat, stock, "plugin.ive"));
    // The suffix puts the kit back.
    EXPECT_TRUE(support::CompareImage()(view(saved + ".(lighting=off).shadowvolume"),
                                        view(_king + ".(lighting=off).shadowvolume"),
                                        "plugin.iveAgain"));
}

TEST_F(ShadowVolumePlugin, optimizerAndThreadsDoNotChangeThePicture)
{
    for (const std::string& model : {_king, support::inventorModel("household/pump.iv")})
    {
        const std::string decorated = model + ".shadowvolume";
        const Picture plain = view(decorated, {{"OSG_OPTIMIZER", "OFF"}});
        ASSERT_TRUE(plain.valid());
        const support::CompareImage compare;
        EXPECT_TRUE(compare(view(decorated), plain, "plugin.optimizer"));
        EXPECT_TRUE(compare(view(decorated, {}, {}), plain, "plugin.threads"));
        EXPECT_TRUE(
            compare(view(decorated, {{"OSG_OPTIMIZER", "OFF"}}, {}), plain, "plugin.threadsAlone"));
        EXPECT_TRUE(compare(view(decorated, {{"OSG_THREADING", "DrawThreadPerContext"}}, {}), plain,
                            "plugin.drawThread"));
        EXPECT_TRUE(compare(
            view(decorated, {{"OSG_THREADING", "CullThreadPerCameraDrawThreadPerContext"}}, {}),
            plain, "plugin.cullThread"));
    }
}

TEST_F(ShadowVolumePlugin, osgconvListsTheOptions)
{
    const support::ProcessResult result = run({"osgconv", "--format", "shadowvolume"});
    for (const char* option :
         {"shadowvolume.lighting=pixel|vertex|off", "shadowvolume.lights=modes|all",
          "shadowvolume.shadows=volumes|map|off", "shadowvolume.technique=auto|tess|geometry|cpu",
          "shadowvolume.mapsize=<16..65536>", "(default volumes)"})
        EXPECT_NE((result.output + result.errors).find(option), std::string::npos) << option;
}

TEST_F(ShadowVolumePlugin, wrongSettingsAreNamedWithThoseThatAreKnown)
{
    const support::ProcessResult result =
        run({"osgconv", _king + ".(lihgting=off).shadowvolume", _folder.file("x.osgt")});
    const std::string text = result.output + result.errors;
    EXPECT_NE(text.find("shadowvolume: setting 'lihgting=off' is not known; there are "
                        "shadows=volumes|map|off, technique=auto|tess|geometry|cpu, "),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("lighting=pixel|vertex|off, lights=modes|all"), std::string::npos) << text;
    EXPECT_NE(result.exitCode, 0);
    EXPECT_FALSE(std::filesystem::exists(_folder.file("x.osgt")));
}

TEST_F(ShadowVolumePlugin, wrongValuesAreNamedWithThoseThatMayBeSaid)
{
    const std::pair<const char*, const char*> cases[] = {
        {"technique=gpu", "setting 'technique=gpu': 'gpu' is none of auto, tess, geometry, cpu"},
        {"mapsize=4", "setting 'mapsize=4': '4' is not a whole number from 16 to 65536"},
        {"shadows", "setting 'shadows=true': 'true' is none of volumes, map, off"},
        {"shadows=map,lighting=vertex", "setting 'shadows=map' needs lighting=pixel"}};
    for (const auto& [settings, message] : cases)
    {
        const support::ProcessResult result = run(
            {"osgconv", _king + ".(" + settings + ").shadowvolume", _folder.file("wrong.osgt")});
        const std::string text = result.output + result.errors;
        EXPECT_NE(text.find(std::string("shadowvolume: ") + message), std::string::npos) << text;
        EXPECT_NE(result.exitCode, 0);
    }
}

TEST_F(ShadowVolumePlugin, shadowsAreOnUnlessTheSettingsSayOtherwise)
{
    const std::pair<const char*, osgShadowVolume::Shadows> cases[] = {
        {"", osgShadowVolume::Shadows::VOLUMES},
        {".(shadows=map)", osgShadowVolume::Shadows::MAP},
        {".(shadows=off)", osgShadowVolume::Shadows::OFF},
        {".(lighting=vertex)", osgShadowVolume::Shadows::OFF}};
    for (const auto& [settings, shadows] : cases)
    {
        const osg::ref_ptr<osg::Node> node =
            osgDB::readRefNodeFile(_king + settings + ".shadowvolume");
        const auto* scene = dynamic_cast<osgShadowVolume::ShadowedScene*>(node.get());
        ASSERT_TRUE(scene) << settings;
        EXPECT_EQ(scene->getShadows(), shadows) << settings;
    }
}

TEST_F(ShadowVolumePlugin, allSettingsOfShadowsAreSavedInEachFormat)
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->addChild(osgDB::readRefNodeFile(_king));
    const std::pair<const char*, const char*> settings[] = {{"shadows", "map"},
                                                            {"technique", "cpu"},
                                                            {"transparent", "none"},
                                                            {"headlight", "shadow"},
                                                            {"layers", "7"},
                                                            {"mapsize", "512"},
                                                            {"pcf", "5"},
                                                            {"mapbudget", "17"},
                                                            {"show", "mask"},
                                                            {"light", "12"},
                                                            {"keys", "off"},
                                                            {"metres", "0.25"},
                                                            {"maxlux", "1234.5"},
                                                            {"candela", "800"},
                                                            {"lux", "90000"},
                                                            {"lights", "all"},
                                                            {"tolerance", "0.125"}};
    for (const auto& [name, text] : settings)
    {
        std::string error;
        ASSERT_TRUE(setSceneOption(*scene, name, text, error)) << error;
    }
    for (const char* extension : {"osgt", "osgb", "osgx", "osg"})
    {
        const std::string file = _folder.file(std::string("all.") + extension);
        ASSERT_TRUE(osgDB::writeNodeFile(*scene, file)) << extension;
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        const auto* read = dynamic_cast<ShadowedScene*>(node.get());
        ASSERT_TRUE(read) << extension;
        EXPECT_EQ(read->getNumChildren(), 1u) << extension;
        for (const osgShadowVolume::SceneOption& option : osgShadowVolume::sceneOptions())
            EXPECT_EQ(option.format(*read), option.format(*scene)) << extension << option.name;
    }
}

TEST_F(ShadowVolumePlugin, filesWithALitSceneStillLoad)
{
    // As version 0.1.0 without shadows wrote them.
    const std::string osgt = _folder.write("old.osgt", R"(#Ascii Scene
#Version 162
#Generator OpenSceneGraph 3.6.5

osgShadowVolume::LitScene {
  UniqueID 1
  Lighting VERTEX
  LightScope ALL
  LightTolerance 0.25
}
)");
    const std::string dotosg = _folder.write("old.osg", R"(osgShadowVolume::LitScene {
  lighting VERTEX
  lightScope ALL
  num_children 0
}
)");
    for (const std::string& file : {osgt, dotosg})
    {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        const auto* scene = dynamic_cast<osgShadowVolume::LitScene*>(node.get());
        ASSERT_TRUE(scene) << file;
        EXPECT_FALSE(dynamic_cast<const ShadowedScene*>(scene));
        EXPECT_EQ(scene->getLighting(), osgShadowVolume::LitScene::Lighting::VERTEX) << file;
        EXPECT_EQ(scene->getLightScope(), osgShadowVolume::LitScene::LightScope::ALL) << file;
    }
}

TEST_F(ShadowVolumePlugin, aWrongValueInAFileIsNamedAndTheDefaultCounts)
{
    const std::string file = _folder.write("wrong.osg", R"(osgShadowVolume::ShadowedScene {
  shadows sharp
  mapsize 3
  pcf 3
  num_children 0
}
)");
    support::NotifyCapture capture;
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
    const auto* scene = dynamic_cast<ShadowedScene*>(node.get());
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->getShadows(), osgShadowVolume::Shadows::VOLUMES);
    EXPECT_EQ(scene->getMapSize(), 1024u);
    EXPECT_EQ(scene->getMapSamples(), 3u);
    const support::NotifyCapture::Lines expected = {
        "osgShadowVolume::ShadowedScene: shadows sharp: 'sharp' is none of volumes, map, off; the "
        "default counts",
        "osgShadowVolume::ShadowedScene: mapsize 3: '3' is not a whole number from 16 to 65536; "
        "the default counts"};
    EXPECT_EQ(capture.takeWarnings(), expected);
}

TEST_F(ShadowVolumePlugin, numbersInFilesThatNoSettingAllowsBecomeTheDefault)
{
    const std::string text = R"(#Ascii Scene
#Version 162
#Generator OpenSceneGraph 3.6.5

osgShadowVolume::ShadowedScene {
  UniqueID 1
  LightTolerance -2
  TransparentLayers 4000000000
  MapSize 0
  MapSamples 3
}
)";
    support::NotifyCapture capture;
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(_folder.write("far.osgt", text));
    const auto* scene = dynamic_cast<ShadowedScene*>(node.get());
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->getTransparentLayers(), 4u);
    EXPECT_EQ(scene->getMapSize(), 1024u);
    EXPECT_EQ(scene->getMapSamples(), 3u);
    EXPECT_EQ(scene->getLightTolerance(), 0.5 / 255.0);
    const support::NotifyCapture::Lines expected = {
        "osgShadowVolume::ShadowedScene: layers in a file: '4000000000' is not a whole number from "
        "0 to 64; the default counts",
        "osgShadowVolume::ShadowedScene: mapsize in a file: '0' is not a whole number from 16 to "
        "65536; the default counts",
        "osgShadowVolume::ShadowedScene: tolerance in a file: '-2' is not a number from 0 to 1; "
        "the default counts"};
    EXPECT_EQ(capture.takeWarnings(), expected);
}

TEST_F(ShadowVolumePlugin, osgviewersHelpHasTheKeys)
{
    const support::ProcessResult result = run({"osgviewer", "-e", "shadowvolume", "--help-keys"});
    ASSERT_FALSE(osgShadowVolume::shadowKeys().empty());
    for (const osgShadowVolume::ShadowKey& key : osgShadowVolume::shadowKeys())
        EXPECT_NE(unwrapped(result.output).find(key.help), std::string::npos)
            << key.key << result.output;
}

TEST_F(ShadowVolumePlugin, withoutADisplayNoKeysAreListed)
{
    const support::ProcessResult result =
        run({"osgviewer", "-e", "egl", "--window", "0", "0", "64", "48", _king + ".shadowvolume"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ((result.output + result.errors).find("keys for shadows"), std::string::npos);
}

TEST_F(ShadowVolumePlugin, belowGL33OneLineSaysSoAndTheFixedFunctionDraws)
{
    const Environment old = {{"MESA_GL_VERSION_OVERRIDE", "2.1"}};
    const Picture stock = view(_king);
    const Picture tier = view(_king + ".shadowvolume", old);
    ASSERT_TRUE(stock && tier);
    EXPECT_TRUE(support::CompareImage()(tier, stock, "plugin.gl21"));
    const support::ProcessResult result =
        run({"osgviewer", "-e", "egl", "--SingleThreaded", "--window", "0", "0", "64", "48",
             _king + ".shadowvolume"},
            old);
    const std::string text = result.output + result.errors;
    const std::string line = "is older than 3.3, so models keep their fixed-function look";
    const std::size_t at = text.find(line);
    EXPECT_NE(at, std::string::npos) << text;
    EXPECT_EQ(text.find(line, at + 1), std::string::npos) << "said once";
}
