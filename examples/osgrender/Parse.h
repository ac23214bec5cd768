// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Vec3d>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace osgrender
{

/// Reads a whole string as a finite number; false when something else is in it.
inline bool parseNumber(const std::string& text, double& value)
{
    if (text.empty() || std::isspace(static_cast<unsigned char>(text[0])))
        return false;
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return *end == '\0' && std::isfinite(value);
}

/// Reads a whole string as a whole number in [low, high].
inline bool parseWhole(const std::string& text, long low, long high, long& value)
{
    double number = 0.0;
    if (!parseNumber(text, number) || number != std::floor(number) || number < double(low) ||
        number > double(high))
        return false;
    value = long(number);
    return true;
}

/// Splits at each separator; "a;;b" has an empty part in the middle, "" is one empty part.
inline std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts(1);
    for (char c : text)
    {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// Reads three numbers with commas between them.
inline bool parseVector(const std::string& text, osg::Vec3d& vector)
{
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3)
        return false;
    for (int i = 0; i < 3; ++i)
    {
        if (!parseNumber(parts[std::size_t(i)], vector[i]))
            return false;
    }
    return true;
}

} // namespace osgrender
