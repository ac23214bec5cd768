// SPDX-License-Identifier: MIT
// osgmerge: merges GPU programs into one and prints it.
#include <osgMultiRender/Import.h>
#include <osgMultiRender/Merger.h>

#include <cstring>
#include <fstream>
#include <iostream>

using namespace osgMultiRender;

namespace
{

constexpr char Help[] = R"(osgmerge merges complete GPU programs into one and prints it.

usage: osgmerge [options] program...

A program is a project of ShaderDesigner (name.gdp), one file of a GLSL pair (name.vert or
name.frag, .vs or .fs; the other one is found beside it), or an image shader (mainImage).

  -o <file>        write <file>.vert and <file>.frag instead of printing
  --list           print each program's qualified variables, functions, globals, texture units
  --map            print what uniforms, attributes and textures are in the merged program
  --stats          print the time that merging took and what is shared
  --base <n>       the program that gives the positions, counted from 0 (default 0)
  --weights <file> GLSL that defines float osgmr_weight(int rendering)
  --glsl <n>       the least GLSL version, 330 or more (default 330)
  --no-share       do not share equal functions, constants, structs and varyings
  --limit <name>=<n>  varyings, samplers, units, uniforms or attributes
  --help           this text

It ends with 0 if all programs are in the merged one, 1 if some were left out, 2 if there is none.
)";

struct Arguments
{
    std::vector<std::string> files;
    std::string output;
    bool list = false, map = false, stats = false;
    MergeOptions options;
};

int complain(const std::string& text)
{
    std::cerr << "osgmerge: " << text << "\n";
    return 2;
}

bool readNumber(const std::string& text, int& value)
{
    if (text.empty() || text.size() > 7 || text.find_first_not_of("0123456789") != std::string::npos)
    {
        return false;
    }
    value = std::stoi(text);
    return true;
}

bool setLimit(const std::string& text, MergeLimits& limits)
{
    const std::size_t equals = text.find('=');
    int value = 0;
    if (equals == std::string::npos || !readNumber(text.substr(equals + 1), value))
    {
        return false;
    }
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
        return false;
    return true;
}

bool readWeights(const std::string& name, std::string& text)
{
    std::ifstream file(name, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    return file.good() || !text.empty();
}

/// An option with a value. Returns a complaint, or nothing.
std::string setOption(const std::string& option, const std::string& value, Arguments& arguments)
{
    int number = 0;
    if (option == "-o")
        arguments.output = value;
    else if (option == "--base" && readNumber(value, number))
        arguments.options.base = static_cast<std::size_t>(number);
    else if (option == "--glsl" && readNumber(value, number))
        arguments.options.version.number = number;
    else if (option == "--weights")
        return readWeights(value, arguments.options.weights) ? "" : value + ": can't be read";
    else if (option != "--limit" || !setLimit(value, arguments.options.limits))
        return option + ": '" + value + "' is not a value for it";
    return "";
}

/// Returns the exit status, or -1 to go on.
int readArguments(int argc, char** argv, Arguments& arguments)
{
    for (int i = 1; i < argc; ++i)
    {
        const std::string option = argv[i];
        const bool valued = option == "-o" || option == "--base" || option == "--glsl" ||
                            option == "--weights" || option == "--limit";
        if (option == "--help" || option == "-h")
        {
            std::cout << Help;
            return 0;
        }
        if (option == "--list")
            arguments.list = true;
        else if (option == "--map")
            arguments.map = true;
        else if (option == "--stats")
            arguments.stats = true;
        else if (option == "--no-share")
            arguments.options.share = false;
        else if (valued)
        {
            if (i + 1 == argc)
                return complain(option + " needs a value; see --help");
            const std::string fault = setOption(option, argv[++i], arguments);
            if (!fault.empty())
                return complain(fault);
        }
        else if (option.size() > 1 && option[0] == '-')
            return complain("unknown option '" + option + "'; see --help");
        else
            arguments.files.push_back(option);
    }
    return arguments.files.empty() ? complain("name at least one program; see --help") : -1;
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
        std::cout << "// vertex stage\n" << merged.vertex << "\n// fragment stage\n" << merged.fragment;
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    const int done = readArguments(argc, argv, arguments);
    if (done >= 0)
        return done;
    std::vector<Rendering> renderings;
    std::vector<MergeEntry> entries;
    bool complete = true;
    renderings.reserve(arguments.files.size());
    for (const std::string& file : arguments.files)
    {
        renderings.push_back(importRendering(file));
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
