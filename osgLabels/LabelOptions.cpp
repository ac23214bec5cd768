// SPDX-License-Identifier: MIT
#include <osgLabels/LabelOptions.h>

#include <osgLabels/MapClasses.h>

#include <osgMultiRender/PseudoLoader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>

namespace osgLabels
{

using osgMultiRender::formatNumber;
using osgMultiRender::parseNumber;

namespace
{

template <class Value> auto setterOf(Value LabelSettings::*member)
{
    return [member](LabelSettings& settings, const Value& value) { settings.*member = value; };
}

template <class Number>
LabelOption number(const char* name, Number LabelSettings::*member, Number low, Number high,
                   const char* help)
{
    return osgMultiRender::numberOption<LabelSettings>(name, help, low, high, member,
                                                       setterOf(member));
}

template <class Value> struct Word
{
    const char* name;
    Value value;
};

template <class Value>
LabelOption choice(const char* name, Value LabelSettings::*member,
                   const std::vector<Word<Value>>& words, const char* help)
{
    return osgMultiRender::wordOption<LabelSettings>(name, help, words, member, setterOf(member));
}

LabelOption flag(const char* name, bool LabelSettings::*member, const char* help)
{
    return choice<bool>(name, member, {{"on", true}, {"off", false}}, help);
}

/// "#rrggbb" or "#rrggbbaa".
bool parseColor(const std::string& text, osg::Vec4& color)
{
    if ((text.size() != 7 && text.size() != 9) || text[0] != '#')
        return false;
    color = osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f);
    for (std::size_t i = 1; i < text.size(); i += 2)
    {
        unsigned int value = 0;
        const char* end = text.data() + i + 2;
        if (std::from_chars(text.data() + i, end, value, 16).ptr != end)
            return false;
        color[int(i / 2)] = float(value) / 255.0f;
    }
    return true;
}

std::string toText(const osg::Vec4& color)
{
    static const char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (int i = 0; i < (color.a() < 1.0f ? 4 : 3); ++i)
    {
        const int value = int(std::lround(std::clamp(color[i], 0.0f, 1.0f) * 255.0f));
        text += {digits[value / 16], digits[value % 16]};
    }
    return text;
}

LabelOption inkOption()
{
    return {"ink", "auto|<#rrggbb[aa]>", "Colour of letters; auto: black or white, whichever shows",
            [](LabelSettings& settings, const std::string& text) -> std::string
            {
                osg::Vec4 color;
                if (text != "auto" && (!parseColor(text, color) || color.a() == 0.0f))
                    return "'" + text + "' is neither auto nor a visible colour #rrggbb";
                settings.styles[0].ink = color;
                return {};
            },
            [](const LabelSettings& settings)
            {
                const osg::Vec4& ink = settings.styles[0].ink;
                return ink.a() == 0.0f ? std::string("auto") : toText(ink);
            }};
}

LabelOption plateOption()
{
    return {"plate", "auto|off|<#rrggbb[aa]>",
            "Plate behind the letters; auto: where an ink has less contrast than 4.5 to 1",
            [](LabelSettings& settings, const std::string& text) -> std::string
            {
                osg::Vec4 color;
                if (text == "auto")
                    color.a() = -1.0f;
                else if (text != "off" && !parseColor(text, color))
                    return "'" + text + "' is neither auto, off nor a colour #rrggbb";
                settings.styles[0].plate = color;
                return {};
            },
            [](const LabelSettings& settings)
            {
                const osg::Vec4& plate = settings.styles[0].plate;
                return plate.a() < 0.0f    ? std::string("auto")
                       : plate.a() == 0.0f ? std::string("off")
                                           : toText(plate);
            }};
}

LabelOption outlineOption()
{
    return {"outline", "off|<#rrggbb:em>",
            "Outline of letters, such as #ffffff:0.05 in shares of the line's height",
            [](LabelSettings& settings, const std::string& text) -> std::string
            {
                LabelStyle& style = settings.styles[0];
                const std::size_t colon = text.find(':');
                osg::Vec4 color;
                float width = 0.0f;
                if (text != "off" &&
                    (colon == std::string::npos || !parseColor(text.substr(0, colon), color) ||
                     !parseNumber(text.substr(colon + 1), width) ||
                     !(width > 0.0f && width <= LabelStyle::MaxOutline)))
                    return "'" + text + "' is neither off nor a colour and a width, 0 to " +
                           formatNumber(LabelStyle::MaxOutline) + ": #ffffff:0.05";
                style.outline = osg::Vec3(color.r(), color.g(), color.b());
                style.outlineWidth = width;
                return {};
            },
            [](const LabelSettings& settings)
            {
                const LabelStyle& style = settings.styles[0];
                return style.outlineWidth == 0.0f ? std::string("off")
                                                  : toText(osg::Vec4(style.outline, 1.0f)) + ":" +
                                                        formatNumber(style.outlineWidth);
            }};
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
            [](const LabelSettings& settings) { return toText(settings.mapColor); }};
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

/// As parseSettings() takes it for one word.
std::string quoted(const std::string& value)
{
    std::string text = "'";
    for (const char c : value)
        text += c == '\'' ? std::string("'\"'\"'") : std::string(1, c);
    return text + "'";
}

} // namespace

const std::vector<LabelOption>& labelOptions()
{
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
        inkOption(),
        plateOption(),
        outlineOption(),
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
    const LabelSettings defaults;
    std::string all;
    for (const LabelOption& option : labelOptions())
    {
        const std::string value = option.format(settings);
        if (value == option.format(defaults))
            continue;
        all += (all.empty() ? "" : ",") + option.name + "=" + quoted(value);
    }
    return all;
}

std::vector<std::string> parseLabelOptions(LabelSettings& settings, const std::string& text)
{
    osgMultiRender::Settings parsed;
    std::string error;
    if (!osgMultiRender::parseSettings(text, parsed, error))
        return {error};
    std::vector<std::string> errors;
    for (const auto& [name, value] : parsed)
        if (!setLabelOption(settings, name, value, error))
            errors.push_back(error);
    return errors;
}

} // namespace osgLabels
