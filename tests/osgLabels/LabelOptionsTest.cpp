// SPDX-License-Identifier: MIT
#include <support/NotifyCapture.h>
#include <support/SettingsPage.h>

#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>

#include <gtest/gtest.h>

#include <map>

using namespace osgLabels;

namespace
{

using Lines = std::vector<std::string>;

const char* const SomeStyles =
    "hot:ink=#ff0000,plate=#000000c0;cold_1.a-ä:ink=#0000ff,outline=#ffffff:0.05;plain:";

/// A text for each option that is not its default.
const std::map<std::string, std::string> Changed = {{"text", "value:tag"},
                                                    {"match", R"(^P-\d+, "it's" [(]x[)]$)"},
                                                    {"font", "/fonts/Some Font.ttf"},
                                                    {"proportional", "on"},
                                                    {"size", "0.3"},
                                                    {"gap", "7.5"},
                                                    {"readable", "0"},
                                                    {"up", "screen"},
                                                    {"texcoord", "2"},
                                                    {"chunk", "on"},
                                                    {"ink", "#ff8000"},
                                                    {"plate", "#10203080"},
                                                    {"outline", "#ffffff:0.05"},
                                                    {"styles", SomeStyles},
                                                    {"keys", "off"}};

LabelSettings allChanged()
{
    LabelSettings settings;
    std::string error;
    for (const auto& [name, text] : Changed)
        EXPECT_TRUE(setLabelOption(settings, name, text, error)) << error;
    return settings;
}

std::string errorOf(const std::string& name, const std::string& text)
{
    LabelSettings settings;
    std::string error;
    EXPECT_FALSE(setLabelOption(settings, name, text, error)) << name << "=" << text;
    return error;
}

/// What may be said, as errors list it.
std::string knownOptions()
{
    return "text=name|description|value:<name>|<file.csv>|<file.json>, match=<regular expression>, "
           "font=<file>, proportional=on|off, size=<0.05..0.9>, gap=<0..1000>, readable=<0..100>, "
           "up=z|y|x|screen, texcoord=<-1..3>, chunk=on|off, ink=auto|<#rrggbb[aa]>, "
           "plate=auto|off|<#rrggbb[aa]>, outline=off|<#rrggbb:em>, "
           "styles=none|<name>:ink=…,plate=…,outline=…;…, keys=on|off";
}

} // namespace

TEST(LabelOptionsTest, eachOptionSetsItsOwnAndSaysItAgain)
{
    ASSERT_EQ(labelOptions().size(), Changed.size());
    const LabelSettings defaults;
    for (const LabelOption& option : labelOptions())
    {
        LabelSettings settings;
        EXPECT_NE(option.format(settings), Changed.at(option.name));
        EXPECT_EQ(option.parse(settings, Changed.at(option.name)), "") << option.name;
        for (const LabelOption& other : labelOptions())
            EXPECT_EQ(other.format(settings),
                      other.name == option.name ? Changed.at(option.name) : other.format(defaults))
                << option.name << " and " << other.name;
    }
}

TEST(LabelOptionsTest, settingsArriveInTheScene)
{
    const LabelSettings settings = allChanged();
    EXPECT_EQ(settings.source, "value:tag");
    EXPECT_EQ(settings.match, Changed.at("match"));
    EXPECT_EQ(settings.font, "/fonts/Some Font.ttf");
    EXPECT_TRUE(settings.proportional);
    EXPECT_EQ(settings.size, 0.3f);
    EXPECT_EQ(settings.gap, 7.5f);
    EXPECT_EQ(settings.readable, 0.0f);
    EXPECT_EQ(settings.up, LabelUp::Screen);
    EXPECT_EQ(settings.texCoord, 2);
    EXPECT_TRUE(settings.chunk);
    EXPECT_FALSE(settings.keys);
    const LabelStyle& style = settings.styles.at(0);
    EXPECT_EQ(style.ink, osg::Vec4(1.0f, 128.0f / 255.0f, 0.0f, 1.0f));
    EXPECT_EQ(style.plate, osg::Vec4(16, 32, 48, 128) / 255.0f);
    EXPECT_EQ(style.outline, osg::Vec3(1.0f, 1.0f, 1.0f));
    EXPECT_EQ(style.outlineWidth, 0.05f);
}

TEST(LabelOptionsTest, stylesAreFoundByTheirNames)
{
    const LabelSettings settings = allChanged();
    ASSERT_EQ(settings.styles.size(), 4u);
    EXPECT_EQ(settings.findStyle(""), 0u);
    EXPECT_EQ(settings.findStyle("default"), 0u);
    EXPECT_EQ(settings.findStyle("hot"), 1u);
    EXPECT_EQ(settings.findStyle("cold_1.a-ä"), 2u);
    EXPECT_EQ(settings.findStyle("plain"), 3u);
    EXPECT_EQ(settings.findStyle("Hot"), std::nullopt);
    EXPECT_EQ(settings.styles[1].ink, osg::Vec4(1, 0, 0, 1));
    EXPECT_EQ(settings.styles[1].plate, osg::Vec4(0, 0, 0, 192) / 255.0f);
    EXPECT_EQ(settings.styles[2].outlineWidth, 0.05f);
    const LabelStyle plain;
    EXPECT_EQ(settings.styles[3].ink, plain.ink) << "not that of the default style";
    EXPECT_EQ(settings.styles[3].plate, plain.plate);
}

TEST(LabelOptionsTest, stylesMayStandInAnyOrderWithSpacesBetween)
{
    LabelSettings settings;
    std::string error;
    ASSERT_TRUE(setLabelOption(settings, "styles", " a: plate=off , ink=#00ff00 ; b:; ", error))
        << error;
    EXPECT_EQ(formatLabelOptions(settings), "styles='a:ink=#00ff00,plate=off;b:'");
    ASSERT_TRUE(setLabelOption(settings, "ink", "#0000ff", error));
    EXPECT_EQ(settings.styles.size(), 3u) << "the default style is another";
    ASSERT_TRUE(setLabelOption(settings, "styles", "none", error));
    EXPECT_EQ(formatLabelOptions(settings), "ink='#0000ff'");
}

TEST(LabelOptionsTest, wrongStylesAreNamedAndSetNothing)
{
    const auto errorOfStyles = [](const std::string& text)
    {
        const std::string error = errorOf("styles", text);
        return error.substr(std::min(error.size(), text.size() + 19));
    };
    EXPECT_EQ(errorOfStyles("hot"), "'hot' lacks a colon after the style's name: hot:ink=#ff0000");
    const std::string noName =
        " is no name of a style; it is made of letters, digits, _ - and ., and is not default";
    EXPECT_EQ(errorOfStyles("a b:ink=#ff0000"), "'a b'" + noName);
    EXPECT_EQ(errorOfStyles("default:ink=#ff0000"), "'default'" + noName);
    EXPECT_EQ(errorOfStyles("hot:#ff0000"), "'#ff0000' of style 'hot' has no value: ink=#ff0000");
    EXPECT_EQ(errorOfStyles("hot:ink=red"), "style 'hot': setting 'ink=red': 'red' is neither auto "
                                            "nor a visible colour #rrggbb");
    EXPECT_EQ(errorOfStyles("hot:size=0.3"),
              "style 'hot': setting 'size=0.3' is not known; there are ink=auto|<#rrggbb[aa]>, "
              "plate=auto|off|<#rrggbb[aa]>, outline=off|<#rrggbb:em>");
    EXPECT_EQ(errorOfStyles("hot:;hot:"), "style 'hot' is there twice");
    std::string many;
    for (int i = 0; i < 15; ++i)
        many += "s" + std::to_string(i) + ":;";
    LabelSettings settings;
    std::string error;
    EXPECT_TRUE(setLabelOption(settings, "styles", many, error)) << error;
    EXPECT_EQ(errorOfStyles(many + "s15:"), "there are more than 15 styles");
}

TEST(LabelOptionsTest, theTextOfAllSettingsReadsBack)
{
    const std::string text = formatLabelOptions(allChanged());
    LabelSettings read;
    EXPECT_EQ(parseLabelOptions(read, text), Lines());
    for (const LabelOption& option : labelOptions())
        EXPECT_EQ(option.format(read), Changed.at(option.name)) << text;
    EXPECT_EQ(formatLabelOptions(LabelSettings()), "") << "defaults need no text";
}

TEST(LabelOptionsTest, defaultsCanBeSaidOverOtherSettings)
{
    LabelSettings settings = allChanged();
    const LabelSettings defaults;
    for (const LabelOption& option : labelOptions())
        EXPECT_EQ(option.parse(settings, option.format(defaults)), "") << option.name;
    EXPECT_EQ(formatLabelOptions(settings), "");
}

TEST(LabelOptionsTest, wrongTextIsNamedWithWhatMayBeSaid)
{
    EXPECT_EQ(errorOf("size", "2"), "setting 'size=2': '2' is not a number from 0.05 to 0.9");
    EXPECT_EQ(errorOf("up", "w"), "setting 'up=w': 'w' is none of z, y, x, screen");
    EXPECT_EQ(errorOf("ink", "red"),
              "setting 'ink=red': 'red' is neither auto nor a visible colour #rrggbb");
    EXPECT_EQ(errorOf("outline", "#ffffff:0.5"), "setting 'outline=#ffffff:0.5': '#ffffff:0.5' is "
                                                 "neither off nor a colour and a width, 0 to "
                                                 "0.125: #ffffff:0.05");
    EXPECT_EQ(errorOf("match", "(").substr(0, 45), "setting 'match=(': '(' is no regular expressi");
    EXPECT_EQ(errorOf("sise", "2"), "setting 'sise=2' is not known; there are " + knownOptions());
}

TEST(LabelOptionsTest, noOptionButThoseOfTextTakesAnythingElse)
{
    ASSERT_FALSE(labelOptions().empty());
    for (const LabelOption& option : labelOptions())
    {
        if (option.name == "text" || option.name == "font" || option.name == "match")
            continue;
        for (const char* text :
             {"",        " ",        "x1",          "1x",      "0x10",     "nan",
              "inf",     "1e999",    "-2",          "1 2",     "+1",       "1,5",
              "On",      "#",        "#12345",      "#12345g", "#1234567", "# 23456",
              "#+12345", "#ffffff:", "#ffffff:nan", ":0.05",   "off:0.1"})
        {
            LabelSettings settings;
            const std::string before = option.format(settings);
            EXPECT_NE(option.parse(settings, text), "") << option.name << "=" << text;
            EXPECT_EQ(option.format(settings), before) << option.name << "=" << text;
        }
    }
}

TEST(LabelOptionsTest, aSceneTakesWhatIsRightInATextAndNamesTheRest)
{
    const osg::ref_ptr<LabelScene> scene = new LabelScene;
    support::NotifyCapture capture;
    scene->setSettingsText("size=0.3,gap=wide,colour=red");
    EXPECT_EQ(scene->getSettingsText(), "size='0.3'");
    Lines warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0], "osgLabels::LabelScene: setting 'colour=red' is not known; there are " +
                               knownOptions() + "; it does not count");
    EXPECT_EQ(warnings[1],
              "osgLabels::LabelScene: setting 'gap=wide': 'wide' is not a number from 0 to 1000; "
              "it does not count");
    scene->setSettingsText("size='0.4");
    EXPECT_EQ(scene->getSettingsText(), "");
    warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "osgLabels::LabelScene: quote that opens at character 6 of 'size='0.4' "
                           "is not closed; it does not count");
}

TEST(LabelOptionsTest, aCopyOfASceneHasItsSettings)
{
    const osg::ref_ptr<LabelScene> scene = new LabelScene;
    scene->setSettings(allChanged());
    scene->setShown(false);
    scene->addChild(new osg::Group);
    const osg::ref_ptr<LabelScene> copy =
        static_cast<LabelScene*>(scene->clone(osg::CopyOp::DEEP_COPY_ALL));
    EXPECT_EQ(copy->getSettingsText(), scene->getSettingsText());
    EXPECT_FALSE(copy->isShown());
    ASSERT_EQ(copy->getNumChildren(), 1u);
    EXPECT_NE(copy->getChild(0), scene->getChild(0));
    EXPECT_EQ(copy->getNumChildrenRequiringEventTraversal(),
              scene->getNumChildrenRequiringEventTraversal());
}

TEST(LabelOptionsTest, eachOptionIsDocumented)
{
    const LabelSettings defaults;
    std::vector<support::DocumentedSetting> settings;
    for (const LabelOption& option : labelOptions())
        settings.push_back({option.name, option.values, option.format(defaults)});
    EXPECT_EQ(support::undocumented(OSGKITS_SETTINGS_PAGE, "## Labels", settings), Lines());
}
