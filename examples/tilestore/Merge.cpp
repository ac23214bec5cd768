// SPDX-License-Identifier: MIT
#include "PackOptions.h"
#include "Subcommand.h"

#include <osgPagedTexture/TileShards.h>

#include <cstdio>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore merge STORE
Makes a store of the parts that lie beside it, as build --shard I/N has left them, and removes them.
It is that of a build in one process, byte for byte. Killed at any moment it leaves the parts, and
the former store or the whole new one.

  --wait S   seconds to wait for another program that writes the store, 0 to 86400; default 0
  --no-sync  does not wait for the disk
  --json     how many parts and tiles there were
  --help     this text
)";

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "STORE")[0];
    const int count = countTileShards(path);
    const TileMergeReport report = mergeTileShards(path, count, packOptionsOf(arguments));
    if (arguments.isJson())
        print({{"store", path},
               {"shards", count},
               {"encodedTiles", report.encodedTiles},
               {"uniformTiles", report.uniformTiles}});
    else
        std::printf("%s: %d parts, %s tiles\n", path.c_str(), count,
                    grouped(report.encodedTiles + report.uniformTiles).c_str());
    return 0;
}

} // namespace

const Subcommand MergeCommand{"merge",
                              "one store of the parts that several processes built",
                              Help,
                              {{"--wait"}, {"--no-sync", false}},
                              run};

} // namespace tilestore
