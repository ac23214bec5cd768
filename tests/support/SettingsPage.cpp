// SPDX-License-Identifier: MIT
#include "SettingsPage.h"

#include <fstream>
#include <map>
#include <sstream>

namespace support
{

namespace
{

/// Rows of the first table below `heading` by the name in their first cell.
std::map<std::string, std::string> rowsBelow(const std::string& page, const std::string& heading)
{
    std::ifstream file(page);
    std::map<std::string, std::string> rows;
    std::string line;
    while (std::getline(file, line) && line != heading)
        ;
    for (bool inTable = false; std::getline(file, line) && (!inTable || line[0] == '|');)
    {
        inTable = line[0] == '|';
        if (line.compare(0, 3, "| `") == 0)
            rows[line.substr(3, line.find('`', 3) - 3)] = line;
    }
    return rows;
}

/// What the row of a setting has to say.
std::vector<std::string> expectedOf(const DocumentedSetting& setting)
{
    std::vector<std::string> expected;
    if (!setting.byDefault.empty())
        expected.push_back(setting.byDefault.substr(0, 7)); // numbers are rounded
    std::istringstream values(setting.values);
    for (std::string value; std::getline(values, value, '|');)
        if (value[0] != '<')
            expected.push_back("`" + value + "`");
    if (const std::size_t dots = setting.values.find(".."); dots != std::string::npos)
        expected.push_back(setting.values.substr(1, dots - 1) + " to " +
                           setting.values.substr(dots + 2, setting.values.size() - dots - 3));
    return expected;
}

} // namespace

std::vector<std::string> undocumented(const std::string& page, const std::string& heading,
                                      const std::vector<DocumentedSetting>& settings)
{
    std::map<std::string, std::string> rows = rowsBelow(page, heading);
    std::vector<std::string> faults;
    for (const DocumentedSetting& setting : settings)
    {
        const std::string row = rows[setting.name];
        for (const std::string& text : expectedOf(setting))
            if (row.find(text) == std::string::npos)
                faults.push_back(setting.name + " lacks " + text);
        if (row.empty())
            faults.push_back(setting.name + " has no row");
        rows.erase(setting.name);
    }
    for (const auto& [name, row] : rows)
        faults.push_back("there is no setting " + name);
    return faults;
}

} // namespace support
