// SPDX-License-Identifier: MIT
#include "StockPrograms.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osgLabels/LabelKeys.h>
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>
#include <osgLabels/PrimitiveBatch.h>

#include <osg/LightSource>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <filesystem>

using osgLabels::LabelScene;

namespace
{

/// Two named things; Inventor's names become names of nodes.
constexpr char Things[] = R"(#Inventor V2.1 ascii
Separator {
  Material { diffuseColor 0.8 0.8 0.75 }
  DEF PUMP-17 Separator { Cube { width 4 height 2 depth 1 } }
  DEF TANK-4 Separator { Translation { translation 4 0 0 } Cylinder { radius 1 height 3 } }
}
)";

constexpr char Ascii[] = "#Ascii Scene\n#Version 162\n#Generator OpenSceneGraph 3.6.5\n\n";

/// What may be said, as errors list it.
std::string knownOptions()
{
    std::string known;
    for (const osgLabels::LabelOption& option : osgLabels::labelOptions())
        known += (known.empty() ? "" : ", ") + option.name + "=" + option.values;
    return known;
}

const char* const Formats[] = {"osgt", "osgb", "osgx", "osg"};

using Lines = support::NotifyCapture::Lines;

class LabelsPlugin : public StockPrograms
{
protected:
    LabelsPlugin()
    {
        _width = 240; // Room for letters of a readable size.
        _height = 120;
    }

    /// Share of the pixels of which one is at least `channel` more than the others.
    static double shareOf(const osg::Image& picture, int channel)
    {
        int count = 0;
        for (int y = 0; y < picture.t(); ++y)
            for (int x = 0; x < picture.s(); ++x)
            {
                const osg::Vec4 color = picture.getColor(unsigned(x), unsigned(y));
                const float others = std::max(color[(channel + 1) % 3], color[(channel + 2) % 3]);
                count += color[channel] > others + 0.5f;
            }
        return double(count) / (picture.s() * picture.t());
    }

    osg::ref_ptr<LabelScene> read(const std::string& file) const
    {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        return dynamic_cast<LabelScene*>(node.get());
    }

    /// A box before a wall under a sun: as a batch or as meshes. The file's name.
    std::string writeThings(bool batched) const
    {
        osg::ref_ptr<osg::Group> scene = new osg::Group;
        osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
        const auto add = [&](const osg::Vec3& center, const osg::Vec3& half)
        {
            osgLabels::Primitive box;
            box.position = center;
            box.size = half;
            batch->add(box);
            scene->addChild(new osg::ShapeDrawable(
                new osg::Box(center, 2.0f * half.x(), 2.0f * half.y(), 2.0f * half.z())));
        };
        add(osg::Vec3(0.0f, 2.0f, 0.0f), osg::Vec3(3.0f, 0.1f, 3.0f));
        add(osg::Vec3(0.0f, 0.0f, 0.0f), osg::Vec3(0.8f, 0.3f, 0.8f));
        if (batched)
        {
            scene->removeChildren(0, scene->getNumChildren());
            batch->build();
            scene->addChild(batch);
        }
        osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
        sun->getLight()->setLightNum(1);
        sun->getLight()->setPosition(osg::Vec4(-0.5f, -1.0f, 0.3f, 0.0f));
        sun->getLight()->setDiffuse(osg::Vec4(0.5f, 0.5f, 0.5f, 1.0f));
        sun->setStateSetModes(*scene->getOrCreateStateSet(), osg::StateAttribute::ON);
        scene->addChild(sun);
        const std::string file = _folder.file(batched ? "batch.osgt" : "meshes.osgt");
        EXPECT_TRUE(osgDB::writeNodeFile(*scene, file));
        return file;
    }

    const std::string _model = _folder.write("things.iv", Things);
};

} // namespace

TEST_F(LabelsPlugin, osgviewerLabelsAModelBySuffix)
{
    const Picture plain = view(_model), labelled = view(_model + ".labels");
    const Picture none = view(_model + ".(match=nothing).labels");
    ASSERT_TRUE(plain && labelled && none);
    EXPECT_TRUE(differ(*plain, *labelled));
    EXPECT_TRUE(support::CompareImage()(none, plain, "labels.none"));
}

TEST_F(LabelsPlugin, settingsAreSaidInBracketsOrOptions)
{
    const Picture red = view(_model + ".(size=0.3,ink=#ff0000).labels");
    const Picture large = view(_model + ".(size=0.6,ink=#ff0000).labels");
    ASSERT_TRUE(red && large);
    EXPECT_GT(shareOf(*red, 0), 0.001) << "a few letters of a few pixels each";
    EXPECT_GT(shareOf(*large, 0), 2.0 * shareOf(*red, 0));
    const support::CompareImage exact{0.0, 0.0, 0.0};
    const std::vector<std::string> options = {"--SingleThreaded", "-O",
                                              "labels.size=0.3 labels.ink=#ff0000"};
    EXPECT_TRUE(exact(view(_model + ".labels", {}, options), red, "labels.option"));
    // Brackets win.
    EXPECT_TRUE(exact(view(_model + ".(size=0.6).labels", {}, options), large, "labels.both"));
}

TEST_F(LabelsPlugin, bothKitsDrawTheSameInEitherOrder)
{
    const Picture inner = view(_model + ".(ink=#ff0000).labels.shadowvolume");
    const Picture outer = view(_model + ".shadowvolume.(ink=#ff0000).labels");
    const Picture shadowed = view(_model + ".shadowvolume");
    ASSERT_TRUE(inner && outer && shadowed);
    EXPECT_TRUE(support::CompareImage()(inner, outer, "labels.order"));
    EXPECT_GT(shareOf(*inner, 0), 0.002);
    EXPECT_TRUE(differ(*inner, *shadowed));
}

TEST_F(LabelsPlugin, batchesCastAndReceiveShadowsLikeMeshes)
{
    const Picture batch = view(writeThings(true) + ".shadowvolume");
    const Picture meshes = view(writeThings(false) + ".shadowvolume");
    const Picture flat = view(writeThings(true) + ".(shadows=off).shadowvolume");
    ASSERT_TRUE(batch && meshes && flat);
    EXPECT_TRUE(differ(*batch, *flat));
    // Edges of the two tessellations may round to neighbouring pixels.
    EXPECT_TRUE((support::CompareImage{4.0 / 255.0, 0.005, 1.0}(batch, meshes, "labels.batch")));
}

TEST_F(LabelsPlugin, wrongSettingsAreNamedWithThoseThatAreKnown)
{
    const std::pair<const char*, std::string> cases[] = {
        {"sise=0.3", "labels: setting 'sise=0.3' is not known; there are " + knownOptions()},
        {"size=3", "labels: setting 'size=3': '3' is not a number from 0.05 to 0.9"},
        {"ink=red",
         "labels: setting 'ink=red': 'red' is neither auto nor a visible colour #rrggbb"},
        {"match=(",
         "labels: bracket that opens at character 14 of 'labels.match=(' is not closed"}};
    for (const auto& [settings, message] : cases)
    {
        const std::string file = _folder.file("wrong.osgt");
        const support::ProcessResult result =
            run({"osgconv", "-O", std::string("labels.") + settings, _model + ".labels", file});
        const std::string text = result.output + result.errors;
        EXPECT_NE(text.find(message), std::string::npos) << text;
        EXPECT_NE(result.exitCode, 0) << settings;
        EXPECT_FALSE(std::filesystem::exists(file)) << settings;
    }
    const support::ProcessResult viewer =
        run({"osgviewer", "-e", "egl", _model + ".(sise=0.3).labels"});
    EXPECT_NE(viewer.exitCode, 0);
    EXPECT_NE((viewer.output + viewer.errors).find(cases[0].second), std::string::npos);
}

TEST_F(LabelsPlugin, osgconvListsTheOptions)
{
    const support::ProcessResult result = run({"osgconv", "--format", "labels"});
    ASSERT_FALSE(osgLabels::labelOptions().empty());
    for (const osgLabels::LabelOption& option : osgLabels::labelOptions())
        EXPECT_NE(
            (result.output + result.errors).find("labels." + option.name + "=" + option.values),
            std::string::npos)
            << option.name << result.output;
}

TEST_F(LabelsPlugin, osgviewersHelpHasTheKeys)
{
    const support::ProcessResult result = run({"osgviewer", "-e", "labels", "--help-keys"});
    ASSERT_FALSE(osgLabels::labelKeys().empty());
    for (const osgLabels::LabelKey& key : osgLabels::labelKeys())
        EXPECT_NE(unwrapped(result.output).find(key.help), std::string::npos)
            << key.key << result.output;
}

TEST_F(LabelsPlugin, savedScenesLookTheSameWhenReadAgain)
{
    const std::string decorated = _model + ".(ink=#ff0000,size=0.4).labels";
    const Picture first = view(decorated);
    ASSERT_TRUE(first.valid());
    EXPECT_GT(shareOf(*first, 0), 0.002);
    for (const char* extension : Formats)
    {
        const std::string saved = convert(decorated, std::string("saved.") + extension);
        EXPECT_TRUE(support::CompareImage()(view(saved), first, "labels.saved." + saved));
        // There and back again.
        const std::string back = convert(saved, std::string("back.") + extension + ".osgt");
        EXPECT_TRUE(support::CompareImage()(view(back), first, "labels.back." + saved));
    }
}

TEST_F(LabelsPlugin, bothKitsAreSavedInEachFormat)
{
    const std::string decorated = _model + ".(ink=#ff0000).labels.shadowvolume";
    const Picture first = view(decorated);
    ASSERT_TRUE(first.valid());
    for (const char* extension : Formats)
        EXPECT_TRUE(
            support::CompareImage()(view(convert(decorated, std::string("kits.") + extension)),
                                    first, std::string("labels.kits.") + extension));
}

TEST_F(LabelsPlugin, allSettingsAreSavedInEachFormat)
{
    const char* const texts[] = {
        R"(text=value:tag,match='^P-\d+ "x", ['"'"'(]',font='/a folder/f.ttf',proportional=on)",
        "size=0.3,gap=7.5,readable=0,up=screen,texcoord=2,chunk=on,keys=off",
        "ink=#ff8000,plate=#10203080,outline=#ffffff:0.05",
        "styles='hot:ink=#ff0000,plate=off;cold:outline=#0000ff:0.05'",
        "",
        "match='<a&b>\n\\\t\xc3\xa4'"};
    for (const char* text : texts)
        for (const char* extension : Formats)
        {
            osg::ref_ptr<LabelScene> scene = new LabelScene;
            scene->setSettingsText(text);
            scene->setShown(*text == '\0');
            scene->addChild(new osg::Group);
            EXPECT_EQ(scene->getSettingsText().empty(), *text == '\0');
            const std::string file = _folder.file(std::string("all.") + extension);
            ASSERT_TRUE(osgDB::writeNodeFile(*scene, file)) << extension;
            const osg::ref_ptr<LabelScene> back = read(file);
            ASSERT_TRUE(back) << extension;
            EXPECT_EQ(back->getSettingsText(), scene->getSettingsText()) << extension;
            EXPECT_EQ(back->isShown(), scene->isShown()) << extension;
            EXPECT_EQ(back->getNumChildren(), 1u) << extension;
        }
}

TEST_F(LabelsPlugin, iveHoldsTheModelWithoutTheKit)
{
    const std::string saved = convert(_model + ".labels", "flat.ive");
    const Picture flat = view(saved), plain = view(_model);
    ASSERT_TRUE(flat && plain);
    EXPECT_TRUE(support::CompareImage()(flat, plain, "labels.ive"));
    EXPECT_TRUE(
        support::CompareImage()(view(saved + ".labels"), view(_model + ".labels"), "labels.again"));
}

TEST_F(LabelsPlugin, unknownAndWrongSettingsInFilesAreNamedAndTheOthersCount)
{
    const std::string osgt = std::string(Ascii) + R"(osgLabels::LabelScene {
  UniqueID 1
  Settings "size='0.3',gap='wide',sparkle='on'"
  Shown FALSE
}
)";
    const std::string dotosg = R"(osgLabels::LabelScene {
  settings "size='0.3',gap='wide',sparkle='on'"
  shown FALSE
  num_children 0
}
)";
    for (const std::string& file :
         {_folder.write("wrong.osgt", osgt), _folder.write("wrong.osg", dotosg)})
    {
        support::NotifyCapture capture;
        const osg::ref_ptr<LabelScene> scene = read(file);
        ASSERT_TRUE(scene) << file;
        EXPECT_EQ(scene->getSettingsText(), "size='0.3'") << file;
        EXPECT_FALSE(scene->isShown()) << file;
        const Lines expected = {
            "osgLabels::LabelScene: setting 'gap=wide': 'wide' is not a number from 0 to 1000; it "
            "does not count",
            "osgLabels::LabelScene: setting 'sparkle=on' is not known; there are " +
                knownOptions() + "; it does not count"};
        EXPECT_EQ(capture.takeWarnings(), expected) << file;
    }
}

TEST_F(LabelsPlugin, brokenTextOfSettingsInAFileIsNamedAndTheDefaultsCount)
{
    const std::string file = _folder.write("broken.osg", R"(osgLabels::LabelScene {
  settings "size='0.3"
  shown PERHAPS
  num_children 0
}
)");
    support::NotifyCapture capture;
    const osg::ref_ptr<LabelScene> scene = read(file);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->getSettingsText(), "");
    EXPECT_TRUE(scene->isShown());
    EXPECT_EQ(capture.takeWarnings(),
              Lines({"osgLabels::LabelScene: quote that opens at character 6 of 'size='0.3' is not "
                     "closed; it does not count"}));
}
