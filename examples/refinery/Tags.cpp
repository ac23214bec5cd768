// SPDX-License-Identifier: MIT
#include "Tags.h"

#include <cstdio>

namespace
{

std::string padded(unsigned int number, int digits)
{
    char text[16];
    std::snprintf(text, sizeof text, "%0*u", digits, number);
    return text;
}

} // namespace

void Tags::startUnit(unsigned int unit)
{
    _unit = unit;
    _equipment = _line = _steel = 0;
}

std::string Tags::equipment(const std::string& letters, char suffix)
{
    // The second of a pair keeps the number of the first.
    if (suffix <= 'A' || letters != _lastLetters)
        ++_equipment;
    _lastLetters = letters;
    std::string tag = letters + "-" + std::to_string(_unit) + padded(_equipment, 3);
    if (suffix)
        tag += suffix;
    return tag;
}

std::string Tags::line(double radiusMetres, const std::string& service)
{
    static const int inches[] = {1, 2, 3, 4, 6, 8, 10, 12, 16, 20, 24, 30, 36};
    static const char* const classes[] = {"A1B", "A3C", "B1A", "B2D", "C1E"};
    int size = inches[0];
    for (int standard : inches)
        if (standard * 0.0254 <= 2.0 * radiusMetres + 1e-9)
            size = standard;
    ++_line;
    return std::to_string(size) + "\"-" + service + "-" + std::to_string(_unit) + padded(_line, 3) +
           "-" + classes[(_unit + _line) % 5];
}

std::string Tags::steel(char kind)
{
    return "ST-" + std::to_string(_unit) + "-" + kind + padded(++_steel, 4);
}
