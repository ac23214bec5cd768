// SPDX-License-Identifier: MIT
#include "Plant.h"

#include <osgDB/WriteFile>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

namespace
{

constexpr char Help[] =
    R"(osgplant [options] FILE
Writes a generated industrial plant: pipes, beams, valves and tanks with names of
their own, and eight lights. The ending says the format: .osgb, .osgt, .osgx, .ive.

  --objects N   how many, 0 to 1000000; default 1000
  --seed N      another number gives another plant; default 1
  --no-lights   without LightSources
  --help        this text
)";

/// A whole number from 0 to `most`; nothing for any other text.
std::optional<unsigned int> numberOf(const std::string& text, unsigned long most)
{
    char* end = nullptr;
    const unsigned long value = std::strtoul(text.c_str(), &end, 10);
    if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos || *end ||
        text.size() > 10 || value > most)
        return std::nullopt;
    return static_cast<unsigned int>(value);
}

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgplant: %s\n", message.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv)
{
    PlantSettings settings;
    std::string file;
    for (int i = 1; i < argc; ++i)
    {
        const std::string argument = argv[i];
        const std::string value = i + 1 < argc ? argv[i + 1] : "";
        if (argument == "--help" || argument == "-h")
            return std::fputs(Help, stdout) < 0;
        if (argument == "--no-lights")
        {
            settings.lights = false;
        }
        else if (argument == "--objects" || argument == "--seed")
        {
            const bool objects = argument == "--objects";
            const auto number =
                numberOf(value, objects ? 1000000 : std::numeric_limits<std::uint32_t>::max());
            if (!number)
                return fail(argument + " needs a whole number" +
                            (objects ? " up to 1000000" : " of 32 bits") + ", not '" + value + "'");
            (objects ? settings.objects : settings.seed) = *number;
            ++i;
        }
        else if (argument[0] == '-' || !file.empty())
        {
            return fail("unknown argument '" + argument + "'; see --help");
        }
        else
        {
            file = argument;
        }
    }
    if (file.empty())
        return fail("no file to write is named; see --help");
    const osg::ref_ptr<osg::Group> plant = makePlant(settings);
    if (!osgDB::writeNodeFile(*plant, file))
        return fail("cannot write '" + file + "': no such folder, or no plugin for its ending");
    std::printf("%s: %u objects, seed %u\n", file.c_str(), settings.objects, settings.seed);
    return 0;
}
