// SPDX-License-Identifier: MIT
#include "City.h"

#include <examples/commandline/CommandLine.h>

#include <osgDB/WriteFile>
#include <osgDB/fstream>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

namespace
{

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgcity: %s\n", message.c_str());
    return 1;
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
    CitySettings settings;
    std::string file, labels;
    examples::CommandLine line(
        "Writes a generated town in hills: streets, houses, blocks around courtyards, towers, "
        "parks and\n"
        "trees; metres, z is up. Buildings are closed meshes named \"Building 17\" and \"Town "
        "Hall\", trees\n"
        "\"tree-4\"; user values labelClass say what is a building, tree, street or terrain.",
        "osgcity");
    line.addFile(file, ".osgb, .osgt, .osgx");
    line.addNumber("--buildings", settings.buildings, 0u, 20000u, "how many");
    line.addNumber("--trees", settings.trees, 0u, 100000u, "how many");
    line.addNumber("--seed", settings.seed, 0u, ~0u, "another number gives another town");
    line.addNumber("--origin", settings.origin, -1e9, 1e9, "x and y of its middle, metres");
    line.add_option("--labels", labels,
                    "also writes a table of map labels, .csv:\nx,y,z,text,priority,style,feature")
        ->type_name("FILE");
    if (const auto status = line.read(argc, argv))
        return *status;
    const City city = makeCity(settings);
    if (!osgDB::writeNodeFile(*city.scene, file))
        return fail("cannot write '" + file + "': no such folder, or no plugin for its ending");
    if (!labels.empty() && !writeLabels(city.labels, labels))
        return fail("cannot write '" + labels + "'; does its folder exist?");
    std::printf("%s: %u buildings, %u trees, seed %u\n", file.c_str(), settings.buildings,
                settings.trees, settings.seed);
    return 0;
}
