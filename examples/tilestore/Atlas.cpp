// SPDX-License-Identifier: MIT
#include "Model.h"
#include "Subcommand.h"

#include <osgPagedTexture/AtlasModel.h>
#include <osgPagedTexture/StoreOverview.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdio>
#include <filesystem>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore atlas MODEL LAYOUT STORE OUTPUT
Writes a model with texture coordinates of an atlas. STORE is the tile store that was built with
LAYOUT: a virtual texture shows it on the model, which has its name, and other viewers show the
coarse picture that the model is given. OUTPUT has any format that OSG writes: .osgb, .obj, ...
Wrapped, repeated and negative coordinates are worked in by cutting triangles.

  --overview N       longest side of the coarse picture, 1 to 16384; default 2048
  --most-repeats N   a photograph that a triangle repeats more often stays a texture of its own;
                     default 256
  --plain            .osgb, .osgt and .osgx, too, are for viewers that lack this kit's plugins;
                     else they are virtual textures that need no suffix
  --json             what was done as JSON
  --help             this text
)";

std::string relativeTo(const std::string& output, const std::string& store)
{
    std::error_code failure;
    const std::filesystem::path folder = std::filesystem::absolute(output).parent_path();
    const std::filesystem::path path = std::filesystem::relative(store, folder, failure);
    return failure || path.empty() ? store : path.generic_string();
}

int run(const Arguments& arguments)
{
    const auto& files = arguments.files(4, 4, "MODEL LAYOUT STORE OUTPUT");
    AtlasModelSettings settings;
    settings.mostRepeats = arguments.number("--most-repeats", 256, 1, 1000000);
    const int side = int(arguments.number("--overview", 2048, 1, 16384));
    const AtlasLayout layout = readAtlasLayout(files[1]);
    const auto store = openTileStore(files[2]);
    settings.overview = readOverview(*store, side);
    settings.store = relativeTo(files[3], files[2]);
    ModelPhotos model = readModel(files[0]);
    const AtlasModelReport report = moveToAtlas(
        model, layout, std::filesystem::absolute(files[1]).parent_path().string(), settings);
    writeAtlasModel(model, files[3],
                    arguments.has("--plain") ? AtlasModelViewer::Plain : AtlasModelViewer::Kit);
    Json left = Json::array();
    for (const LeftSurface& each : report.left)
        left.push_back({{"name", each.name}, {"reason", each.reason}});
    for (const LeftSurface& each : report.left)
        std::fprintf(stderr, "'%s' keeps its texture on a drawable: %s\n", each.name.c_str(),
                     each.reason.c_str());
    if (arguments.isJson())
        print({{"model", files[3]},
               {"store", settings.store},
               {"drawables", report.drawables},
               {"triangles", report.triangles},
               {"splitTriangles", report.split},
               {"writtenTriangles", report.written},
               {"notFiniteTriangles", report.notFinite},
               {"largestRoundingPixels", report.largestRounding},
               {"left", left}});
    else
        std::printf("%s: %s drawables, %s triangles, %s of them cut, %s after; coordinates are "
                    "rounded by %.4f pixels at most\n",
                    files[3].c_str(), grouped(report.drawables).c_str(),
                    grouped(report.triangles).c_str(), grouped(report.split).c_str(),
                    grouped(report.written).c_str(), report.largestRounding);
    return 0;
}

} // namespace

const Subcommand AtlasCommand{"atlas",
                              "a model with coordinates of the atlas",
                              Help,
                              {{"--overview"}, {"--most-repeats"}, {"--plain", false}},
                              run};

} // namespace tilestore
