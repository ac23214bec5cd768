// SPDX-License-Identifier: MIT
#include "BuildConfig.h"

#include <osgPagedTexture/TileBuildText.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace tilestore
{

namespace fs = std::filesystem;

namespace
{

/// An option, and the member of a configuration file that says the same.
struct Setting
{
    const char* option;
    const char* member;
    enum class Kind
    {
        Number,
        Text,
        Color,
        Path, ///< In a file, relative to that file.
        Flag
    } kind;
};

constexpr Setting Settings[] = {
    {"--photos", "photos", Setting::Kind::Path},
    {"--store", "store", Setting::Kind::Path},
    {"--output", "output", Setting::Kind::Text},
    {"--tile-side", "tileSide", Setting::Kind::Number},
    {"--border", "border", Setting::Kind::Number},
    {"--format", "format", Setting::Kind::Text},
    {"--quality", "quality", Setting::Kind::Number},
    {"--subsampling", "subsampling", Setting::Kind::Text},
    {"--compression", "compression", Setting::Kind::Number},
    {"--block-quality", "blockQuality", Setting::Kind::Text},
    {"--channels", "channels", Setting::Kind::Number},
    {"--filter", "filter", Setting::Kind::Text},
    {"--background", "background", Setting::Kind::Color},
    {"--lossless", "lossless", Setting::Kind::Flag},
    {"--atlas", "atlas", Setting::Kind::Path},
    {"--atlas-side", "atlasSide", Setting::Kind::Number},
    {"--padding", "padding", Setting::Kind::Number},
    {"--max-width", "maxWidth", Setting::Kind::Number},
    {"--memory", "memory", Setting::Kind::Text},
    {"--threads", "threads", Setting::Kind::Number},
    {"--not-updatable", "notUpdatable", Setting::Kind::Flag},
    {"--no-sync", "noSync", Setting::Kind::Flag},
};

const char* const LayoutFormat = "osgKits atlas layout";

Json readJson(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("'" + path +
                                 "' cannot be read; name a folder of photographs, a "
                                 "configuration file or a layout");
    try
    {
        return Json::parse(file);
    }
    catch (const Json::exception& error)
    {
        std::string cause = error.what();
        std::replace(cause.begin(), cause.end(), '\n', ' ');
        throw std::runtime_error("'" + path + "' is no JSON (" + cause +
                                 "); of a model, make a layout first: osgtilestore layout");
    }
}

void checkMembers(const Json& config, const std::string& path)
{
    if (!config.is_object())
        throw std::runtime_error("'" + path + "' is no JSON object");
    for (const auto& member : config.items())
        if (std::none_of(std::begin(Settings), std::end(Settings),
                         [&](const Setting& each) { return member.key() == each.member; }))
            throw std::runtime_error("'" + path + "' has the unknown member '" + member.key() +
                                     "'; see osgtilestore build --help");
}

Json valueOf(const Setting& setting, const Arguments& arguments)
{
    const std::string text = arguments.get(setting.option, "");
    if (setting.kind == Setting::Kind::Number)
        return parseNumber(text, setting.option, 0, std::int64_t(1) << 40);
    if (setting.kind == Setting::Kind::Color)
        return arguments.numbers(setting.option, 3, 4);
    if (setting.kind == Setting::Kind::Flag)
        return true;
    return text;
}

std::string textOf(const Json& config, const char* member)
{
    const auto found = config.find(member);
    if (found == config.end())
        return {};
    if (!found->is_string())
        throw std::runtime_error(std::string(member) + " must be a text, not " + found->dump());
    return found->get<std::string>();
}

std::int64_t numberOf(const Json& config, const char* member, std::int64_t standard,
                      std::int64_t most)
{
    const auto found = config.find(member);
    if (found == config.end())
        return standard;
    if (!found->is_number_integer() || *found < 0 || *found > most)
        throw std::runtime_error(std::string(member) + " must be a whole number from 0 to " +
                                 std::to_string(most) + ", not " + found->dump());
    return found->get<std::int64_t>();
}

bool flagOf(const Json& config, const char* member)
{
    const auto found = config.find(member);
    if (found == config.end())
        return false;
    if (!found->is_boolean())
        throw std::runtime_error(std::string(member) + " must be true or false, not " +
                                 found->dump());
    return found->get<bool>();
}

/// "photos/" and "photos" name a store "photos.tiles".
std::string besides(const std::string& path, const std::string& ending)
{
    fs::path name = fs::path(path).lexically_normal();
    if (!name.has_filename())
        name = name.parent_path();
    if (name.filename() == "." || name.filename() == "..")
        name = fs::absolute(name).lexically_normal();
    if (!name.has_filename())
        name = name.parent_path();
    if (!fs::is_directory(path))
    {
        name.replace_extension();
        if (name.extension() == ".layout")
            name.replace_extension();
        if (name.extension() == ".tiles")
            return name.string();
    }
    return name.string() + ending;
}

Output outputOf(const Json& config, const std::string& store)
{
    const std::string text = textOf(config, "output");
    if (text == "pack" || (text.empty() && fs::path(store).extension() != ".dzi"))
        return Output::Pack;
    if (text == "libvt")
        return Output::LibVT;
    if (text == "deepzoom" || text.empty())
        return Output::DeepZoom;
    throw std::runtime_error("output must be one of pack, libvt, deepzoom, not '" + text + "'");
}

/// Members of the file that `path` is, or where its photographs are.
Json readInput(const std::string& path, BuildConfig& build)
{
    if (fs::is_directory(path))
        return {{"photos", path}};
    Json config = readJson(path);
    if (config.is_object() && textOf(config, "format").rfind(LayoutFormat, 0) == 0)
    {
        build.layout = path;
        build.makeLayout = false;
        return Json::object();
    }
    checkMembers(config, path);
    for (const Setting& setting : Settings)
        if (setting.kind == Setting::Kind::Path && !textOf(config, setting.member).empty())
            config[setting.member] =
                (fs::path(path).parent_path() / textOf(config, setting.member)).string();
    return config;
}

} // namespace

OptionList buildOptions()
{
    OptionList options;
    for (const Setting& setting : Settings)
        options.push_back({setting.option, setting.kind != Setting::Kind::Flag});
    return options;
}

BuildConfig readBuildConfig(const Arguments& arguments)
{
    const std::string input = arguments.files(1, 1, "CONFIG, FOLDER or LAYOUT")[0];
    BuildConfig build;
    Json config = readInput(input, build);
    for (const Setting& setting : Settings)
        if (arguments.has(setting.option))
            config[setting.member] = valueOf(setting, arguments);

    build.photos = textOf(config, "photos");
    if (build.makeLayout && build.photos.empty())
        throw std::runtime_error("'" + input + "' names no photographs; add \"photos\": a folder");
    build.store = textOf(config, "store");
    if (build.store.empty())
        build.store = besides(input, textOf(config, "output") == "deepzoom" ? ".dzi" : ".tiles");
    build.output = outputOf(config, build.store);
    if (build.makeLayout)
        build.layout = build.store + ".layout.json";

    // Deep Zoom's pictures have no border at the edges, and viewers expect none elsewhere.
    if (build.output == Output::DeepZoom)
        config.emplace("edge", "clipped");
    config.emplace("border", build.output == Output::DeepZoom ? 0 : 8);
    build.settings = osgPagedTexture::parseBuild(config.dump());
    build.settings.everyTile = build.output == Output::LibVT;
    build.settings.threads = unsigned(numberOf(config, "threads", 0, 1024));
    if (const std::string memory = textOf(config, "memory"); !memory.empty())
        build.settings.maxBytes = parseBytes(memory, "memory");
    build.channelsGiven = config.contains("channels");
    build.backgroundGiven = config.contains("background");
    build.atlas = textOf(config, "atlas");
    build.atlasSide = numberOf(config, "atlasSide", build.atlasSide, std::int64_t(1) << 30);
    build.padding = int(numberOf(config, "padding", -1, 65536));
    build.maxWidth = numberOf(config, "maxWidth", 0, osgPagedTexture::TileGrid::MaxSide);
    build.updatable = !flagOf(config, "notUpdatable") && build.output == Output::Pack;
    build.durable = !flagOf(config, "noSync");
    return build;
}

} // namespace tilestore
