// SPDX-License-Identifier: MIT
#include <osgLabels/LabelOptions.h>

#include <osgLabels/MapClasses.h>
#include <osgLabels/StyleText.h>

#include <osgMultiRender/OptionText.h>

#include <regex>

namespace osgLabels
{

namespace
{

using osgMultiRender::choice;
using osgMultiRender::flag;
using osgMultiRender::number;

/// Of the style of all objects without one of their own.
LabelOption defaultStyle(const osgMultiRender::Option<LabelStyle>& part)
{
    return {part.name, part.values, part.help,
            [parse = part.parse](LabelSettings& settings, const std::string& text)
            { return parse(settings.styles[0], text); },
            [format = part.format](const LabelSettings& settings)
            { return format(settings.styles[0]); }};
}

LabelOption stylesOption()
{
    return {"styles", "none|<name>:ink=…,plate=…,outline=…;…",
            "Named looks of labels, such as hot:ink=#ff0000;cold:ink=#0000ff,plate=off",
            parseStyles, formatStyles};
}

LabelOption matchOption()
{
    return {"match", "<regular expression>",
            "Only objects whose name it matches somewhere have a label (ECMAScript)",
            [](LabelSettings& settings, const std::string& text) -> std::string
            {
                try
                {
                    const std::regex check(text);
                }
                catch (const std::regex_error& error)
                {
                    return "'" + text + "' is no regular expression: " + error.what();
                }
                settings.match = text;
                return {};
            },
            [](const LabelSettings& settings) { return settings.match; }};
}

LabelOption classOption()
{
    return {"mapclass", "<pattern:action>",
            "The same by the name, or the user value \"labelClass\", of what stands there",
            [](LabelSettings& settings, const std::string& text) -> std::string
            {
                MapClasses check;
                std::string error;
                if (check.parse(text, error))
                    settings.mapClass = text;
                return error;
            },
            [](const LabelSettings& settings) { return settings.mapClass; }};
}

LabelOption colorOption()
{
    return {"mapcolor", "<#rrggbb>", "Colour of letters that are recoloured",
            [](LabelSettings& settings, const std::string& text) -> std::string
            {
                osg::Vec4 color;
                if (!parseColor(text, color) || color.a() < 1.0f)
                    return "'" + text + "' is no colour #rrggbb";
                settings.mapColor = color;
                return {};
            },
            [](const LabelSettings& settings) { return formatColor(settings.mapColor); }};
}

LabelOption text(const char* name, std::string LabelSettings::*member, const char* values,
                 const char* help)
{
    return {name, values, help,
            [=](LabelSettings& settings, const std::string& value) -> std::string
            {
                settings.*member = value;
                return {};
            },
            [=](const LabelSettings& settings) { return settings.*member; }};
}

} // namespace

const std::vector<LabelOption>& labelOptions()
{
    const std::vector<osgMultiRender::Option<LabelStyle>>& style = styleOptions();
    static const std::vector<LabelOption> options = {
        text("text", &LabelSettings::source, "name|description|value:<name>|<file.csv>|<file.json>",
             "What is written on an object: its nearest name, its description, a user value, or "
             "what a table has for its name"),
        matchOption(),
        text("font", &LabelSettings::font, "<file>", "Font that FreeType opens"),
        flag("proportional", &LabelSettings::proportional,
             "Letters take their own width instead of equal cells"),
        number("size", &LabelSettings::size, 0.05f, 0.9f,
               "Height of text as a share of the room across its line"),
        number("gap", &LabelSettings::gap, 0.0f, 1000.0f,
               "Least gap between repetitions along an object, in heights of the text"),
        number("readable", &LabelSettings::readable, 0.0f, 100.0f,
               "Pixels of height below which text fades out"),
        choice<LabelUp>(
            "up", &LabelSettings::up,
            {{"z", LabelUp::Z}, {"y", LabelUp::Y}, {"x", LabelUp::X}, {"screen", LabelUp::Screen}},
            "The world's way up, which text on walls keeps to"),
        number("texcoord", &LabelSettings::texCoord, -1, 3,
               "Texture unit whose coordinates place the text; -1: by shape"),
        flag("chunk", &LabelSettings::chunk, "Gathers many small drawables into few large ones"),
        defaultStyle(style[0]),
        defaultStyle(style[1]),
        defaultStyle(style[2]),
        stylesOption(),
        choice<SurfaceLabels>(
            "surface", &LabelSettings::surface,
            {{"auto", SurfaceLabels::Auto}, {"on", SurfaceLabels::On}, {"off", SurfaceLabels::Off}},
            "Labels on the surfaces of objects; auto: where no map is given"),
        text("map", &LabelSettings::map, "off|values|<file.csv>",
             "Labels that face the viewer: of nodes with a user value \"label\", and of a table "
             "with "
             "x, y, z, text, priority, style and feature"),
        number("mapsize", &LabelSettings::mapSize, 1.0f, 1000.0f,
               "Height of a line of map labels in pixels"),
        number("mapworld", &LabelSettings::mapWorld, 0.0f, 1e9f,
               "Height of a line in units of the scene; 0: mapsize counts"),
        number("mapoffset", &LabelSettings::mapOffset, 0.0f, 1e9f,
               "Units by which map labels are nearer to the eye than their anchors"),
        choice<MapDepth>("mapdepth", &LabelSettings::mapDepth,
                         {{"anchor", MapDepth::Anchor}, {"back", MapDepth::Back}},
                         "How far away a map label is: as its anchor, or just before the back of "
                         "its own feature"),
        choice<MapAction>("mapaction", &LabelSettings::mapAction,
                          {{"hide", MapAction::Hide},
                           {"outline", MapAction::Outline},
                           {"recolor", MapAction::Recolor},
                           {"fade", MapAction::Fade},
                           {"ignore", MapAction::Ignore}},
                          "What happens to the part of a map label that something stands before"),
        classOption(),
        choice<MapTest>(
            "maptest", &LabelSettings::mapTest,
            {{"pixel", MapTest::Pixel}, {"anchor", MapTest::Anchor}, {"share", MapTest::Share}},
            "What is asked whether something stands before it: each pixel of a map "
            "label; its anchor, for all of it; how much of it is visible"),
        number("mapleader", &LabelSettings::mapLeader, 0.0f, 1000.0f,
               "Pixels of a line from the anchor up to the label"),
        number("mapfade", &LabelSettings::mapFade, 0.0f, 1.0f, "Opacity of what is faded"),
        colorOption(),
        flag("declutter", &LabelSettings::declutter,
             "Of map labels that overlap only the most important one is shown"),
        flag("keys", &LabelSettings::keys, "Answers to keys in osgviewer"),
    };
    return options;
}

bool setLabelOption(LabelSettings& settings, const std::string& name, const std::string& value,
                    std::string& error)
{
    return osgMultiRender::setOption(labelOptions(), settings, name, value, error);
}

std::string formatLabelOptions(const LabelSettings& settings)
{
    return osgMultiRender::formatOptions(labelOptions(), settings);
}

std::vector<std::string> parseLabelOptions(LabelSettings& settings, const std::string& text)
{
    return osgMultiRender::parseOptions(labelOptions(), settings, text);
}

} // namespace osgLabels
