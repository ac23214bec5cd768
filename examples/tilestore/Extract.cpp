// SPDX-License-Identifier: MIT
#include "Subcommand.h"

#include <osgPagedTexture/TileExtract.h>

#include <cstdio>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore extract STORE PICTURE
Writes a part of a level of a store as a picture, for looking; the ending says the format: .png,
.tif, .jpg, .ppm or another that OpenImageIO writes. STORE is a packed store, a folder of LibVT's
layout, or a .dzi file.

  --level L         0 is the full size; default: the finest that is at most 4096 pixels a side
  --region X,Y,W,H  in pixels of that level, from its top left corner; default: all of it
  --channels N      1 red or grey, 3 RGB, 4 RGBA; default 3
  --background R,G,B[,A]  where there is nothing, 0 to 255 each; default 255,255,255,255
  --json            what was written
  --help            this text
)";

int levelToLookAt(const TileGrid& grid)
{
    int level = 0;
    while (level + 1 < grid.getLevels() &&
           std::max(grid.getWidth(level), grid.getHeight(level)) > 4096)
        ++level;
    return level;
}

ExtractSettings settingsOf(const Arguments& arguments)
{
    ExtractSettings settings;
    settings.channels = int(arguments.number("--channels", 3, 1, 4));
    if (settings.channels == 2)
        throw UsageError("--channels needs 1, 3 or 4, not '2'");
    const auto background = arguments.numbers("--background", 3, 4);
    for (std::size_t i = 0; i < background.size(); ++i)
    {
        if (background[i] < 0 || background[i] > 255)
            throw UsageError("--background needs numbers from 0 to 255");
        settings.background[i] = static_cast<std::uint8_t>(background[i]);
    }
    return settings;
}

int run(const Arguments& arguments)
{
    const auto& files = arguments.files(2, 2, "STORE PICTURE");
    const ExtractSettings settings = settingsOf(arguments);
    const auto reader = openTileStore(files[0]);
    const TileGrid& grid = reader->getSettings().grid;
    const int level =
        int(arguments.number("--level", levelToLookAt(grid), 0, grid.getLevels() - 1));
    PixelRect region{0, 0, grid.getWidth(level), grid.getHeight(level)};
    const auto numbers = arguments.numbers("--region", 4, 4);
    if (!numbers.empty())
        region = {numbers[0], numbers[1], numbers[2], numbers[3]};
    extractRegion(*reader, level, region, settings, files[1]);
    if (arguments.isJson())
        print({{"picture", files[1]}, {"level", level}});
    else
        std::printf("%s: level %d\n", files[1].c_str(), level);
    return 0;
}

} // namespace

const Subcommand ExtractCommand{"extract",
                                "a part of a store as a picture",
                                Help,
                                {{"--level"}, {"--region"}, {"--channels"}, {"--background"}},
                                run};

} // namespace tilestore
