// SPDX-License-Identifier: MIT
#include "Drawables.h"
#include "Inventor.h"

#include <examples/commandline/CommandLine.h>

#include <osg/Version>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <cstdio>
#include <fstream>
#include <map>
#include <string>

namespace
{

constexpr unsigned int MostInBatch = 2000000, MostOrdinary = 300000;

struct Command
{
    RefinerySettings settings;
    std::string file;
    bool batch = true, quads = false;
    DrawableLabels labels = DrawableLabels::None;
};

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgrefinery: %s\n", message.c_str());
    return 1;
}

void declare(examples::CommandLine& line, Command& command)
{
    line.addFile(command.file, ".osgb, .osgt, .osgx, or .iv for\nInventor text");
    line.addNumber("--objects", command.settings.objects, 0u, MostInBatch,
                   "how many; for .iv and --as drawables to 300000");
    line.addNumber("--seed", command.settings.seed, 0u, ~0u,
                   "another number gives another refinery");
    line.addChoice<bool>("--as", command.batch, {{"batch", true}, {"drawables", false}},
                         "batch: one osgLabels::PrimitiveBatch (the default); drawables:\n"
                         "one osg::Geometry an object, each in a Geode with its name");
    line.addChoice<DrawableLabels>(
        "--labels", command.labels,
        {{"text", DrawableLabels::Text}, {"texture", DrawableLabels::Texture}},
        "with --as drawables: an osgText::Text or a texture an object");
    line.add_flag("--quads", command.quads,
                  "quads of random sizes and places instead of a refinery");
}

/// What does not go together, or an empty text.
std::string findFault(const Command& command)
{
    const bool inventor = osgDB::getLowerCaseFileExtension(command.file) == "iv";
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
    examples::CommandLine line("Writes a generated refinery: pipe racks, vessels, towers, tanks, "
                               "spheres, pumps and steel, each\n"
                               "with a tag of its own, on a ground without.",
                               "osgrefinery");
    declare(line, command);
    if (const auto status = line.read(argc, argv))
        return *status;
    if (const std::string fault = findFault(command); !fault.empty())
        return fail(fault);
    if (!write(command))
        return fail("cannot write '" + command.file +
                    "': no such folder, or no plugin for its ending");
    std::printf("%s: %u objects, seed %u\n", command.file.c_str(), command.settings.objects,
                command.settings.seed);
    return 0;
}
