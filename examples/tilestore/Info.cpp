// SPDX-License-Identifier: MIT
#include "Subcommand.h"

#include <osgPagedTexture/TilePack.h>

#include <cstdio>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore info STORE
Says what a store holds: the size of the picture, its levels, how many tiles are files, of one
colour, or nothing at all, and what of a packed store's file is still in use. STORE is a packed
store, a folder of LibVT's layout, or a .dzi file.

  --json   the same as JSON
  --help   this text
)";

Json describe(const TileStoreSettings& settings)
{
    const TileGrid& grid = settings.grid;
    Json json;
    json["width"] = grid.getWidth();
    json["height"] = grid.getHeight();
    json["tileSide"] = grid.getTileSide();
    json["border"] = grid.getBorder();
    json["edge"] = grid.getEdge() == TileGrid::Edge::Padded ? "padded" : "clipped";
    json["format"] = settings.format;
    json["tiles"] = grid.getTileCount();
    const Json settingsJson = Json::parse(settings.description, nullptr, false);
    if (!settings.description.empty())
        json["settings"] = settingsJson.is_discarded() ? Json(settings.description) : settingsJson;
    for (int level = 0; level < grid.getLevels(); ++level)
        json["levels"].push_back({{"level", level},
                                  {"width", grid.getWidth(level)},
                                  {"height", grid.getHeight(level)},
                                  {"columns", grid.getColumns(level)},
                                  {"rows", grid.getRows(level)}});
    return json;
}

void addPack(const TilePackReader& pack, Json& json)
{
    const TilePackInfo info = pack.getInfo();
    json["generation"] = info.generation;
    json["encodedTiles"] = info.encodedTiles;
    json["uniformTiles"] = info.uniformTiles;
    json["absentTiles"] =
        pack.getSettings().grid.getTileCount() - info.encodedTiles - info.uniformTiles;
    json["bytes"] = info.committedBytes;
    json["liveBytes"] = info.liveBytes;
    json["deadShare"] = info.getDeadShare();
    if (!info.warning.empty())
        json["warning"] = info.warning;
    const std::vector<TileLevelInfo> levels = pack.countTiles();
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
        Json& line = json["levels"][level];
        line["encodedTiles"] = levels[level].encodedTiles;
        line["uniformTiles"] = levels[level].uniformTiles;
        line["encodedBytes"] = levels[level].encodedBytes;
    }
}

void printText(const std::string& path, const TileStoreSettings& settings, const Json& json)
{
    const TileGrid& grid = settings.grid;
    std::printf("%s: %s x %s pixels, %d levels, tiles of %d pixels with a border of %d, %s\n",
                path.c_str(), grouped(grid.getWidth()).c_str(), grouped(grid.getHeight()).c_str(),
                grid.getLevels(), grid.getTileSide(), grid.getBorder(), settings.format.c_str());
    const bool packed = json.contains("generation");
    std::printf("level       width      height       tiles%s\n",
                packed ? "     encoded     uniform      absent       bytes" : "");
    for (const Json& level : json["levels"])
    {
        const auto text = [&](const char* key) { return grouped(level[key].get<std::uint64_t>()); };
        const std::uint64_t tiles =
            level["columns"].get<std::uint64_t>() * level["rows"].get<std::uint64_t>();
        std::printf("%5d %11s %11s %11s", level["level"].get<int>(), text("width").c_str(),
                    text("height").c_str(), grouped(tiles).c_str());
        if (packed)
            std::printf(" %11s %11s %11s %11s", text("encodedTiles").c_str(),
                        text("uniformTiles").c_str(),
                        grouped(tiles - level["encodedTiles"].get<std::uint64_t>() -
                                level["uniformTiles"].get<std::uint64_t>())
                            .c_str(),
                        text("encodedBytes").c_str());
        std::printf("\n");
    }
    if (packed)
        std::printf("%s, of which %.1f %% are dead; commit %s\n",
                    byteText(json["bytes"].get<std::uint64_t>()).c_str(),
                    100.0 * json["deadShare"].get<double>(),
                    grouped(json["generation"].get<std::uint64_t>()).c_str());
    if (json.contains("warning"))
        std::fprintf(stderr, "%s\n", json["warning"].get<std::string>().c_str());
}

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "STORE")[0];
    const auto reader = openTileStore(path);
    Json json = describe(reader->getSettings());
    if (const auto* pack = dynamic_cast<const TilePackReader*>(reader.get()))
        addPack(*pack, json);
    if (arguments.isJson())
        print(json);
    else
        printText(path, reader->getSettings(), json);
    return 0;
}

} // namespace

const Subcommand InfoCommand{"info", "what a store holds", Help, {}, run};

} // namespace tilestore
