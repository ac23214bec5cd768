// SPDX-License-Identifier: MIT
// osgmerge: merges GPU programs into one and prints it.
#include <examples/commandline/CommandLine.h>

#include <osgMultiRender/Import.h>
#include <osgMultiRender/Merger.h>

#include <fstream>
#include <iostream>

using namespace osgMultiRender;

namespace
{

struct Arguments
{
    std::vector<std::string> files;
    std::string output, weights;
    bool list = false, map = false, stats = false;
    MergeOptions options;
};

int complain(const std::string& text)
{
    std::cerr << "osgmerge: " << text << "\n";
    return 2;
}

/// Name and number. Returns what is wrong, or nothing.
std::string setLimit(const std::string& text, MergeLimits& limits)
{
    const std::size_t equals = text.find('=');
    int value = 0;
    if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), value) ||
        value < 0)
        return "'" + text + "' is not NAME=N";
    const std::string name = text.substr(0, equals);
    if (name == "varyings")
        limits.varyingVectors = value;
    else if (name == "samplers")
        limits.fragmentSamplers = limits.vertexSamplers = value;
    else if (name == "units")
        limits.textureUnits = value;
    else if (name == "uniforms")
        limits.vertexUniformComponents = limits.fragmentUniformComponents = value;
    else if (name == "attributes")
        limits.vertexAttributes = value;
    else
        return "'" + name + "' is none of varyings, samplers, units, uniforms, attributes";
    return {};
}

void declareLimits(examples::CommandLine& line, MergeLimits& limits)
{
    line.add_option_function<std::vector<std::string>>(
            "--limit",
            [&limits](const std::vector<std::string>& texts)
            {
                for (const std::string& text : texts)
                    if (const std::string fault = setLimit(text, limits); !fault.empty())
                        throw CLI::ValidationError("--limit", fault);
            },
            "varyings, samplers, units, uniforms or attributes; may be\nrepeated")
        ->expected(1)
        ->take_all()
        ->type_name("NAME=N");
}

void declare(examples::CommandLine& line, Arguments& arguments)
{
    line.add_option("PROGRAM", arguments.files,
                    "a project of ShaderDesigner (name.gdp), one file of a GLSL\n"
                    "pair (name.vert or name.frag, .vs or .fs; the other one is\n"
                    "found beside it), an image shader (mainImage), or the name\n"
                    "of a built-in rendering")
        ->type_name("")
        ->required();
    line.add_option("-o", arguments.output,
                    "writes <FILE>.vert and <FILE>.frag instead of printing")
        ->type_name("FILE");
    line.add_flag("--list", arguments.list,
                  "prints each program's qualified variables, functions,\nglobals, texture units");
    line.add_flag("--map", arguments.map,
                  "prints what uniforms, attributes and textures are in the\nmerged program");
    line.add_flag("--stats", arguments.stats,
                  "prints the time that merging took and what is shared");
    line.addNumber<std::size_t>("--base", arguments.options.base, 0, 9999,
                                "the program that gives the positions, counted from 0");
    line.add_option("--weights", arguments.weights,
                    "GLSL that defines float osgmr_weight(int rendering)")
        ->type_name("FILE");
    line.addNumber("--glsl", arguments.options.version.number, 0, 9999,
                   "the least GLSL version, 330 or more");
    line.add_flag_callback(
        "--no-share", [&arguments] { arguments.options.share = false; },
        "does not share equal functions, constants, structs and\nvaryings");
    line.add_flag("--own-lighting", arguments.options.ownLighting,
                  "projects have the lights and materials that they hold, not\nthe scene's");
    declareLimits(line, arguments.options.limits);
    line.footer(
        "It ends with 0 if all programs are in the merged one, 1 if some were left out, 2 if "
        "there is none.");
}

/// False where the file can't be read.
bool readWeights(Arguments& arguments)
{
    if (arguments.weights.empty())
        return true;
    std::ifstream file(arguments.weights, std::ios::binary);
    arguments.options.weights.assign(std::istreambuf_iterator<char>(file),
                                     std::istreambuf_iterator<char>());
    return file.good() || !arguments.options.weights.empty();
}

void printList(const char* title, const std::vector<std::string>& lines)
{
    std::cout << "  " << title << "\n";
    for (const std::string& line : lines)
        std::cout << "    " << line << "\n";
}

void printLists(const Merged& merged)
{
    for (const MergedRendering& one : merged.renderings)
    {
        std::cout << one.name << (one.included ? "" : " (left out)") << "\n";
        printList("qualified variables", one.qualified);
        printList("functions", one.functions);
        printList("globals", one.globals);
        std::vector<std::string> units;
        for (unsigned int unit : one.textureUnits)
            units.push_back(std::to_string(unit));
        printList("texture units", units);
    }
}

void printMap(const Merged& merged, const std::vector<Rendering>& renderings)
{
    for (const MergedUniform& one : merged.uniforms)
    {
        std::cout << "uniform " << renderings[one.rendering].name << "." << one.name << " -> "
                  << one.type << " " << one.merged;
        if (one.arraySize)
            std::cout << "[" << one.arraySize << "]";
        for (unsigned int unit : one.units)
            std::cout << " unit " << unit;
        std::cout << "\n";
    }
    for (const MergedAttribute& one : merged.attributes)
    {
        std::cout << "attribute " << one.name << " -> " << one.type << " " << one.merged;
        if (one.location >= 0)
            std::cout << " location " << one.location;
        std::cout << "\n";
    }
    for (const MergedTexture& one : merged.textures)
    {
        const RenderingTexture* texture = renderings[one.rendering].findTexture(one.ownUnit);
        std::cout << "unit " << one.unit << ": "
                  << (one.own && texture ? texture->fileName : "the model's texture") << "\n";
    }
}

void printStatistics(const Merged& merged)
{
    const MergeStatistics& s = merged.statistics;
    std::cout << "merged in " << s.milliseconds << " ms\n"
              << "shared: " << s.sharedFunctions << " functions, " << s.sharedConstants
              << " constants, " << s.sharedStructs << " structs, " << s.sharedVaryings
              << " varyings\n"
              << "varyings: " << s.varyingComponents << " components in " << s.varyingVectors
              << " vectors\n"
              << "samplers: " << s.fragmentSamplers << " fragment, " << s.vertexSamplers
              << " vertex; texture units up to " << s.textureUnits << "\n"
              << "uniform components: " << s.fragmentUniformComponents << " fragment, "
              << s.vertexUniformComponents << " vertex\n"
              << "vertex attributes: " << s.vertexAttributes << "\n";
}

bool write(const std::string& name, const std::string& text)
{
    std::ofstream file(name, std::ios::binary);
    file << text;
    return file.good();
}

int print(const Arguments& arguments, const Merged& merged)
{
    if (!arguments.output.empty())
    {
        const std::string& stem = arguments.output;
        if (!write(stem + ".vert", merged.vertex) || !write(stem + ".frag", merged.fragment))
            return complain(stem + ": can't be written");
        return 0;
    }
    if (!arguments.list && !arguments.map && !arguments.stats)
        std::cout << "// vertex stage\n"
                  << merged.vertex << "\n// fragment stage\n"
                  << merged.fragment;
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    examples::CommandLine line("Merges complete GPU programs into one and prints it.", "osgmerge");
    declare(line, arguments);
    if (const auto status = line.read(argc, argv, 2))
        return *status;
    if (!readWeights(arguments))
        return complain(arguments.weights + ": can't be read");
    std::vector<Rendering> renderings;
    std::vector<MergeEntry> entries;
    bool complete = true;
    renderings.reserve(arguments.files.size());
    for (const std::string& file : arguments.files)
    {
        renderings.push_back(importNamed(file));
        for (const RenderingMessage& message : renderings.back().messages)
            std::cerr << (message.error ? "error: " : "note: ") << message.text << "\n";
        if (renderings.back().ok())
        {
            entries.push_back({&renderings.back(), 1.0});
        }
        else
        {
            renderings.pop_back();
            complete = false;
        }
    }
    const Merged merged = mergeRenderings(entries, arguments.options);
    for (const MergeMessage& message : merged.messages)
    {
        const char* const words[] = {"note: ", "warning: ", "error: "};
        std::cerr << words[static_cast<int>(message.severity)] << message.text << "\n";
        complete = complete && message.severity != MergeSeverity::Error;
    }
    if (arguments.list)
        printLists(merged);
    if (!merged.ok)
        return complain("there is nothing to merge");
    if (arguments.map)
        printMap(merged, renderings);
    if (arguments.stats)
        printStatistics(merged);
    const int written = print(arguments, merged);
    return written ? written : complete ? 0 : 1;
}
