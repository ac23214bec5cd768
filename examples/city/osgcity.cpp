// SPDX-License-Identifier: MIT
#include "City.h"

#include <osgDB/WriteFile>
#include <osgDB/fstream>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace
{

constexpr char Help[] =
    R"(osgcity [options] FILE
Writes a generated town in hills: streets, houses, blocks around courtyards, towers, parks and
trees; metres, z is up. Buildings are closed meshes named "Building 17" and "Town Hall", trees
"tree-4"; user values labelClass say what is a building, tree, street or terrain. The ending says
the format: .osgb, .osgt, .osgx.

  --buildings N  how many, 0 to 20000; default 500
  --trees N      how many, 0 to 100000; default 1000
  --seed N       another number gives another town; default 1
  --origin X     the x and y of its middle, metres, up to 1e9 from 0; default 0
  --labels FILE  also writes a table of map labels, .csv: x,y,z,text,priority,style,feature
  --out FILE     the same as FILE
  --help         this text
)";

constexpr unsigned int MostBuildings = 20000, MostTrees = 100000;

struct Command
{
    CitySettings settings;
    std::string file, labels;
    bool help = false;
};

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgcity: %s\n", message.c_str());
    return 1;
}

/// False for what is no number from 0 to `most`.
bool readCount(const std::string& text, unsigned int most, std::uint32_t& value)
{
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure != std::errc() || stop != end || number > most)
        return false;
    value = number;
    return true;
}

bool readOrigin(const std::string& text, double& value)
{
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    return failure == std::errc() && stop == end && std::abs(value) <= 1e9;
}

/// One option with its value. Returns what is wrong, or an empty text.
std::string set(Command& command, const std::string& option, const std::string& value)
{
    const auto count = [&](unsigned int most, std::uint32_t& number) -> std::string
    {
        if (readCount(value, most, number))
            return {};
        return option + " needs a whole number up to " + std::to_string(most) + ", not '" + value +
               "'";
    };
    if (option == "--buildings")
        return count(MostBuildings, command.settings.buildings);
    if (option == "--trees")
        return count(MostTrees, command.settings.trees);
    if (option == "--seed")
        return count(std::numeric_limits<std::uint32_t>::max(), command.settings.seed);
    if (option == "--origin")
        return readOrigin(value, command.settings.origin)
                   ? ""
                   : "--origin needs a number from -1e9 to 1e9, not '" + value + "'";
    if (option == "--labels" && !value.empty())
        command.labels = value;
    else if (option == "--out" && !value.empty() && command.file.empty())
        command.file = value;
    else
        return "'" + option + " " + value + "' is no option; see --help";
    return {};
}

std::string parse(int argc, char** argv, Command& command)
{
    for (int i = 1; i < argc; ++i)
    {
        const std::string argument = argv[i];
        std::string fault;
        if (argument == "--help" || argument == "-h")
            command.help = true;
        else if (argument.rfind("-", 0) == 0)
            fault = set(command, argument, ++i < argc ? argv[i] : "");
        else if (command.file.empty())
            command.file = argument;
        else
            fault = "'" + argument + "' is a second file; see --help";
        if (!fault.empty() || command.help)
            return fault;
    }
    return command.file.empty() ? "no file to write is named; see --help" : "";
}

std::string quoted(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

/// As short as it can be read back, in any locale.
std::string numberText(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

bool writeLabels(const std::vector<osgLabels::MapLabel>& labels, const std::string& file)
{
    osgDB::ofstream out(file.c_str(), std::ios::binary);
    out << "x,y,z,text,priority,style,feature\n";
    for (const osgLabels::MapLabel& label : labels)
    {
        for (int axis = 0; axis < 3; ++axis)
            out << numberText(label.anchor[axis]) << ',';
        out << quoted(label.text) << ',' << numberText(label.priority) << ',' << label.style << ','
            << quoted(label.feature) << '\n';
    }
    return bool(out.flush());
}

} // namespace

int main(int argc, char** argv)
{
    Command command;
    const std::string fault = parse(argc, argv, command);
    if (!fault.empty())
        return fail(fault);
    if (command.help)
        return std::fputs(Help, stdout) < 0;
    const City city = makeCity(command.settings);
    if (!osgDB::writeNodeFile(*city.scene, command.file))
        return fail("cannot write '" + command.file +
                    "': no such folder, or no plugin for its ending");
    if (!command.labels.empty() && !writeLabels(city.labels, command.labels))
        return fail("cannot write '" + command.labels + "'; does its folder exist?");
    std::printf("%s: %u buildings, %u trees, seed %u\n", command.file.c_str(),
                command.settings.buildings, command.settings.trees, command.settings.seed);
    return 0;
}
