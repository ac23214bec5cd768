// SPDX-License-Identifier: MIT
#include "Plant.h"

#include <examples/commandline/CommandLine.h>

#include <osgDB/WriteFile>

#include <cstdio>
#include <string>

int main(int argc, char** argv)
{
    PlantSettings settings;
    std::string file;
    examples::CommandLine line(
        "Writes a generated industrial plant: pipes, beams, valves and tanks with names of\n"
        "their own, and eight lights.",
        "osgplant");
    line.addFile(file, ".osgb, .osgt, .osgx, .ive");
    line.addNumber("--objects", settings.objects, 0u, 1000000u, "how many");
    line.addNumber("--seed", settings.seed, 0u, ~0u, "another number gives another plant");
    line.add_flag_callback(
        "--no-lights", [&settings] { settings.lights = false; }, "without LightSources");
    if (const auto status = line.read(argc, argv))
        return *status;
    const osg::ref_ptr<osg::Group> plant = makePlant(settings);
    if (!osgDB::writeNodeFile(*plant, file))
    {
        std::fprintf(stderr,
                     "osgplant: cannot write '%s': no such folder, or no plugin for its ending\n",
                     file.c_str());
        return 1;
    }
    std::printf("%s: %u objects, seed %u\n", file.c_str(), settings.objects, settings.seed);
    return 0;
}
