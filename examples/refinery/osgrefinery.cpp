// SPDX-License-Identifier: MIT
#include "Drawables.h"
#include "Inventor.h"

#include <osg/Version>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace
{

constexpr char Help[] =
    R"(osgrefinery [options] FILE
Writes a generated refinery: pipe racks, vessels, towers, tanks, spheres, pumps and
steel, each with a tag of its own, on a ground without. The ending says the format: .osgb, .osgt,
.osgx, or .iv for Inventor text.

  --objects N    how many, 0 to 2000000; for .iv and --as drawables to 300000
  --seed N       another number gives another refinery; default 1
  --as batch     one osgLabels::PrimitiveBatch (default)
  --as drawables one osg::Geometry an object, each in a Geode with its name
  --labels text | texture
                 with --as drawables: an osgText::Text or a texture an object
  --quads        quads of random sizes and places instead of a refinery
  --out FILE     the same as FILE
  --help         this text
)";

constexpr unsigned int MostInBatch = 2000000, MostOrdinary = 300000;

struct Command
{
    RefinerySettings settings;
    std::string file;
    bool batch = true, quads = false, help = false;
    DrawableLabels labels = DrawableLabels::None;
};

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgrefinery: %s\n", message.c_str());
    return 1;
}

std::optional<unsigned int> numberOf(const std::string& text, unsigned long most)
{
    char* end = nullptr;
    const unsigned long value = std::strtoul(text.c_str(), &end, 10);
    if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos || *end ||
        text.size() > 10 || value > most)
        return std::nullopt;
    return static_cast<unsigned int>(value);
}

/// One option with its value. Returns what is wrong, or an empty text.
std::string set(Command& command, const std::string& option, const std::string& value)
{
    if (option == "--objects" || option == "--seed")
    {
        const bool objects = option == "--objects";
        const auto number =
            numberOf(value, objects ? MostInBatch : std::numeric_limits<std::uint32_t>::max());
        if (!number)
            return option + " needs a whole number" +
                   (objects ? " up to " + std::to_string(MostInBatch) : " of 32 bits") + ", not '" +
                   value + "'";
        (objects ? command.settings.objects : command.settings.seed) = *number;
    }
    else if (option == "--as" && (value == "batch" || value == "drawables"))
        command.batch = value == "batch";
    else if (option == "--labels" && (value == "text" || value == "texture"))
        command.labels = value == "text" ? DrawableLabels::Text : DrawableLabels::Texture;
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
        else if (argument == "--quads")
            command.quads = true;
        else if (argument.rfind("-", 0) == 0)
            fault = set(command, argument, ++i < argc ? argv[i] : "");
        else if (command.file.empty())
            command.file = argument;
        else
            fault = "'" + argument + "' is a second file; see --help";
        if (!fault.empty() || command.help)
            return fault;
    }
    const bool inventor = osgDB::getLowerCaseFileExtension(command.file) == "iv";
    if (command.file.empty())
        return "no file to write is named; see --help";
    if (command.labels != DrawableLabels::None && (command.batch || inventor))
        return "--labels needs --as drawables and no .iv";
    if ((inventor || !command.batch) && command.settings.objects > MostOrdinary)
        return std::to_string(command.settings.objects) +
               " objects are too many one by one; at most " + std::to_string(MostOrdinary) +
               ", or --as batch in a .osgb";
    return {};
}

void make(const Command& command, const AddPrimitive& add)
{
    (command.quads ? makeQuads : makeRefinery)(command.settings, add);
}

bool write(const Command& command)
{
    using osgLabels::Primitive;
    if (osgDB::getLowerCaseFileExtension(command.file) == "iv")
    {
        std::ofstream out(command.file, std::ios::binary);
        {
            InventorWriter writer(out);
            make(command, [&](const Primitive& primitive) { writer.add(primitive); });
        }
        return bool(out.flush());
    }
    if (!command.batch)
    {
        Drawables drawables(command.labels);
        make(command, [&](const Primitive& primitive) { drawables.add(primitive); });
        return osgDB::writeNodeFile(*drawables.get(), command.file);
    }
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    batch->setName(command.quads ? "Quads" : "Refinery");
    batch->reserve(command.settings.objects, std::size_t(16) * command.settings.objects);
    make(command, [&](const Primitive& primitive) { batch->add(primitive); });
    batch->build();
    // Without it the file would be written, without the objects.
    if (!osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(
            "osgLabels::PrimitiveBatch"))
    {
        std::fprintf(stderr,
                     "osgrefinery: the plugin osgdb_serializers_osglabels is not found; set "
                     "OSG_LIBRARY_PATH to the folder that holds osgPlugins-%s\n",
                     osgGetVersion());
        return false;
    }
    return osgDB::writeNodeFile(*batch, command.file);
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
    if (!write(command))
        return fail("cannot write '" + command.file +
                    "': no such folder, or no plugin for its ending");
    std::printf("%s: %u objects, seed %u\n", command.file.c_str(), command.settings.objects,
                command.settings.seed);
    return 0;
}
