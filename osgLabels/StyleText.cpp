// SPDX-License-Identifier: MIT
#include <osgLabels/StyleText.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace osgLabels
{

using osgMultiRender::formatNumber;
using osgMultiRender::parseNumber;

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

std::string formatColor(const osg::Vec4& color)
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

namespace
{

using Part = osgMultiRender::Option<LabelStyle>;

Part inkPart()
{
    return {"ink", "auto|<#rrggbb[aa]>", "Colour of letters; auto: black or white, whichever shows",
            [](LabelStyle& style, const std::string& text) -> std::string
            {
                osg::Vec4 color;
                if (text != "auto" && (!parseColor(text, color) || color.a() == 0.0f))
                    return "'" + text + "' is neither auto nor a visible colour #rrggbb";
                style.ink = color;
                return {};
            },
            [](const LabelStyle& style)
            {
                const osg::Vec4& ink = style.ink;
                return ink.a() == 0.0f ? std::string("auto") : formatColor(ink);
            }};
}

Part platePart()
{
    return {"plate", "auto|off|<#rrggbb[aa]>",
            "Plate behind the letters; auto: where an ink has less contrast than 4.5 to 1",
            [](LabelStyle& style, const std::string& text) -> std::string
            {
                osg::Vec4 color;
                if (text == "auto")
                    color.a() = -1.0f;
                else if (text != "off" && !parseColor(text, color))
                    return "'" + text + "' is neither auto, off nor a colour #rrggbb";
                style.plate = color;
                return {};
            },
            [](const LabelStyle& style)
            {
                const osg::Vec4& plate = style.plate;
                return plate.a() < 0.0f    ? std::string("auto")
                       : plate.a() == 0.0f ? std::string("off")
                                           : formatColor(plate);
            }};
}

Part outlinePart()
{
    return {"outline", "off|<#rrggbb:em>",
            "Outline of letters, such as #ffffff:0.05 in shares of the line's height",
            [](LabelStyle& style, const std::string& text) -> std::string
            {
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
            [](const LabelStyle& style)
            {
                return style.outlineWidth == 0.0f ? std::string("off")
                                                  : formatColor(osg::Vec4(style.outline, 1.0f)) +
                                                        ":" + formatNumber(style.outlineWidth);
            }};
}

std::vector<std::string> split(const std::string& text, char at)
{
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();)
    {
        const std::size_t end = std::min(text.find(at, begin), text.size());
        const std::size_t first = text.find_first_not_of(' ', begin);
        if (first < end)
            parts.push_back(text.substr(first, text.find_last_not_of(' ', end - 1) + 1 - first));
        begin = end + 1;
    }
    return parts;
}

/// "hot:ink=#ff0000,plate=off".
std::string parseStyle(LabelStyle& style, const std::string& text)
{
    const std::size_t colon = text.find(':');
    style.name = text.substr(0, colon);
    if (colon == std::string::npos)
        return "'" + text + "' lacks a colon after the style's name: " + text + ":ink=#ff0000";
    if (!isStyleName(style.name) || style.name == LabelStyle::DefaultName)
        return "'" + style.name + "' is no name of a style; it is made of letters, digits, _ - " +
               "and ., and is not " + LabelStyle::DefaultName;
    for (const std::string& part : split(text.substr(colon + 1), ','))
    {
        const std::size_t equals = part.find('=');
        std::string error;
        if (equals == std::string::npos)
            return "'" + part + "' of style '" + style.name + "' has no value: ink=#ff0000";
        if (!osgMultiRender::setOption(styleOptions(), style, part.substr(0, equals),
                                       part.substr(equals + 1), error))
            return "style '" + style.name + "': " + error;
    }
    return {};
}

} // namespace

const std::vector<Part>& styleOptions()
{
    static const std::vector<Part> options = {inkPart(), platePart(), outlinePart()};
    return options;
}

std::string parseStyles(LabelSettings& settings, const std::string& text)
{
    LabelSettings read;
    const std::vector<std::string> parts =
        text == "none" ? std::vector<std::string>() : split(text, ';');
    if (parts.empty() && text != "none")
        return "it names no style; none is for none";
    for (const std::string& part : parts)
    {
        LabelStyle style;
        const std::string error = parseStyle(style, part);
        if (!error.empty())
            return error;
        if (read.findStyle(style.name))
            return "style '" + style.name + "' is there twice";
        if (read.styles.size() == LabelStyle::MaxStyles)
            return "there are more than " + std::to_string(LabelStyle::MaxStyles - 1) + " styles";
        read.styles.push_back(style);
    }
    read.styles[0] = settings.styles[0];
    settings.styles = read.styles;
    return {};
}

std::string formatStyles(const LabelSettings& settings)
{
    std::string text;
    for (std::size_t i = 1; i < settings.styles.size(); ++i)
    {
        const LabelStyle& style = settings.styles[i];
        text += (text.empty() ? "" : ";") + style.name;
        char separator = ':';
        for (const Part& part : styleOptions())
            if (const std::string value = part.format(style); value != part.format(LabelStyle()))
            {
                text += separator + part.name + "=" + value;
                separator = ',';
            }
        if (separator == ':')
            text += ':';
    }
    return text.empty() ? "none" : text;
}

} // namespace osgLabels
