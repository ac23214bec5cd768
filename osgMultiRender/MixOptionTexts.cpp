// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixOptionTexts.h>

#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixFile.h>
#include <osgMultiRender/MixOptions.h>

#include <osgDB/FileUtils>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace osgMultiRender
{

namespace
{

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);)
        if (part.find_first_not_of(' ') != std::string::npos)
            parts.push_back(part);
    return parts;
}

std::string formatNumbers(const std::vector<double>& numbers)
{
    std::string text;
    for (const double number : numbers)
        text += (text.empty() ? "" : " ") + formatNumber(number);
    return text;
}

} // namespace

std::string parseRenderings(MixedScene& scene, const std::string& text)
{
    std::vector<std::pair<std::string, MixRange>> parsed;
    for (const std::string& part : split(text, ';'))
    {
        std::string name = part;
        std::vector<double> numbers;
        MixRange range;
        const std::size_t colon = part.rfind(':');
        if (colon != std::string::npos && parseNumbers(part.substr(colon + 1), numbers))
        {
            name = part.substr(0, colon);
            const std::string cause = makeRange(numbers, range);
            if (!cause.empty())
                return "'" + part + "': " + cause;
        }
        parsed.emplace_back(name, range);
    }
    for (const auto& [name, range] : parsed)
    {
        const std::string file = osgDB::findDataFile(name);
        scene.addRendering(importNamed(file.empty() ? name : file), range);
    }
    return {};
}

std::string formatRenderings(const MixedScene& scene)
{
    std::string text;
    for (const unsigned int number : scene.getRenderings())
    {
        const std::shared_ptr<const Rendering> rendering = scene.getRendering(number);
        const MixRange range = scene.getRange(number);
        text += (text.empty() ? "" : ";") +
                (rendering->fileName.empty() ? rendering->name : rendering->fileName) + ":" +
                formatNumbers({range.dr0, range.dr1, range.dr2, range.dr3});
    }
    return text;
}

std::string parsePoints(MixedScene& scene, const std::string& text)
{
    std::vector<osg::Vec3d> points;
    for (const std::string& part : split(text, ';'))
    {
        std::vector<double> numbers;
        if (!parseNumbers(part, numbers) || numbers.size() != 3)
            return "'" + part + "' is no point; write three numbers, 'x,y,z;x,y,z'";
        points.emplace_back(numbers[0], numbers[1], numbers[2]);
    }
    scene.setKeyPoints(points, scene.getKeyMode());
    return {};
}

std::string formatPoints(const MixedScene& scene)
{
    std::string text;
    for (const osg::Vec3d& point : scene.getKeyPoints())
        text += (text.empty() ? "" : ";") + formatNumbers({point.x(), point.y(), point.z()});
    return text;
}

std::string parseBase(MixedScene& scene, const std::string& text)
{
    MixRules rules = scene.getRules();
    rules.base = -1;
    for (const unsigned int number : scene.getRenderings())
        if (text == std::to_string(number) ||
            (rules.base < 0 && text == scene.getRendering(number)->name))
            rules.base = int(number);
    if (rules.base < 0 && text != "none")
        return "there is no rendering '" + text + "'; name one, its number or 'none'";
    scene.setRules(rules);
    return {};
}

std::string formatBase(const MixedScene& scene)
{
    const int base = scene.getRules().base;
    return base < 0 ? "none" : std::to_string(base);
}

std::string parseBackground(MixedScene& scene, const std::string& text)
{
    MixRules rules = scene.getRules();
    unsigned int digits = 0;
    const bool isColor = (text.size() == 7 || text.size() == 9) && text[0] == '#' &&
                         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (isColor)
        std::sscanf(text.c_str() + 1, "%x", &digits);
    else if (text != "none" && text != "transparent")
        return "'" + text + "' is none of none, transparent, #rrggbb, #rrggbbaa";
    if (text.size() == 7 && isColor)
        digits = digits << 8 | 0xffu;
    rules.background =
        glm::dvec4(digits >> 24, digits >> 16 & 255u, digits >> 8 & 255u, digits & 255u) / 255.0;
    scene.setTransparent(text == "transparent");
    scene.setRules(rules);
    return {};
}

std::string formatBackground(const MixedScene& scene)
{
    if (scene.isTransparent())
        return "transparent";
    const glm::dvec4 color = scene.getRules().background;
    if (color.a <= 0.0)
        return "none";
    char text[10];
    const auto byte = [](double x)
    { return unsigned(std::lround(255.0 * glm::clamp(x, 0.0, 1.0))); };
    std::snprintf(text, sizeof text, "#%02x%02x%02x%02x", byte(color.r), byte(color.g),
                  byte(color.b), byte(color.a));
    return text;
}

std::string parseUniforms(MixedScene& scene, const std::string& text)
{
    for (const std::string& part : split(text, ';'))
    {
        const std::size_t equals = part.find('='), dot = part.find('.');
        std::vector<double> values;
        if (dot == std::string::npos || equals == std::string::npos || dot > equals ||
            !parseNumbers(part.substr(equals + 1), values))
            return "'" + part + "' is no uniform; write 'rendering.uniform=1,0.5,0'";
        const std::string owner = part.substr(0, dot),
                          name = part.substr(dot + 1, equals - dot - 1);
        bool isSet = false;
        for (const unsigned int number : scene.getRenderings())
        {
            const std::shared_ptr<const Rendering> rendering = scene.getRendering(number);
            if (owner != rendering->name && owner != std::to_string(number))
                continue;
            if (rendering->ok() && !rendering->findUniform(name))
                return "rendering '" + owner + "' has no uniform '" + name + "'";
            isSet = scene.setUniform(number, name, values) || isSet;
        }
        if (!isSet)
            return "there is no rendering '" + owner + "'";
    }
    return {};
}

std::string formatUniforms(const MixedScene&)
{
    return {};
}

std::string parseMix(MixedScene& scene, const std::string& text)
{
    std::string error;
    const std::string file = osgDB::findDataFile(text);
    return readMixFile(scene, file.empty() ? text : file, error) ? std::string() : error;
}

bool parseNumbers(const std::string& text, std::vector<double>& numbers)
{
    std::string words = text;
    std::replace(words.begin(), words.end(), ',', ' ');
    std::istringstream stream(words);
    for (std::string word; stream >> word;)
    {
        double number = 0.0;
        if (!parseNumber(word, number) || std::isnan(number))
            return false;
        numbers.push_back(number);
    }
    return !numbers.empty();
}

std::string makeRange(const std::vector<double>& numbers, MixRange& range)
{
    if (numbers.empty() || numbers.size() > 4)
        return "a range is one to four distances, dr0, dr1, dr2, dr3";
    range = MixRange();
    range.dr0 = numbers[0];
    range.dr1 = numbers.size() > 1 ? numbers[1] : numbers[0];
    if (numbers.size() > 2)
        range.dr2 = range.dr3 = numbers[2];
    if (numbers.size() > 3)
        range.dr3 = numbers[3];
    return {};
}

} // namespace osgMultiRender
