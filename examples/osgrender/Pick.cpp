// SPDX-License-Identifier: MIT
#include "Pick.h"

#include "Parse.h"

namespace osgrender
{

bool parsePick(const std::string& text, PickPoint& point, std::string& error)
{
    const std::vector<std::string> parts = split(text, ',');
    long x = 0, y = 0;
    if (parts.size() != 2 || !parseWhole(parts[0], 0, 65535, x) ||
        !parseWhole(parts[1], 0, 65535, y))
    {
        error = "'" + text + "' is not a pixel X,Y from the lower left corner, like 400,300";
        return false;
    }
    point = {int(x), int(y)};
    return true;
}

std::string pickText(const std::vector<PickResult>& results)
{
    std::string text;
    for (const PickResult& result : results)
    {
        text += "pick " + std::to_string(result.point.x) + "," + std::to_string(result.point.y);
        text += result.identifier ? ": " + std::to_string(result.identifier) + " '" + result.text +
                                        "' " + result.path + "\n"
                                  : ": nothing labelled\n";
    }
    return text;
}

} // namespace osgrender
