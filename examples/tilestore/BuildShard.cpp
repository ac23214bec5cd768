// SPDX-License-Identifier: MIT
#include "BuildShard.h"

#include <osgPagedTexture/TileShards.h>

#include <cstdio>
#include <filesystem>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;
namespace fs = std::filesystem;

TileShard shardOf(const std::string& text)
{
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos)
        throw UsageError("--shard needs a part and their number, such as 1/4, not '" + text + "'");
    const auto count = parseNumber(text.substr(slash + 1), "--shard", 1, 9999);
    const auto part = parseNumber(text.substr(0, slash), "--shard", 1, count);
    return {int(part) - 1, int(count)};
}

/// That of the other parts: the first one makes it, unless it is there and of these photographs.
AtlasLayout sharedLayout(const BuildConfig& build, std::vector<std::string>& failures)
{
    if (!build.makeLayout)
        return readAtlasLayout(build.layout);
    constexpr double anHour = 3600.0; // a million photographs take some time to read
    const AtlasLock lock(build.layout, anHour);
    const std::string folder = fs::path(build.layout).parent_path().string();
    if (fs::exists(build.layout))
    {
        AtlasLayout layout = readAtlasLayout(build.layout);
        const AtlasChanges changes = findChanges(layout, folder, findPhotosOf(layout, folder),
                                                 false, build.settings.threads);
        for (const DescribedPhotos::Failure& failure : changes.failures)
            failures.push_back(failure.cause);
        if (changes.changed.empty() && changes.added.empty() && changes.removed.empty() &&
            changes.moved.empty() && layout.pending.empty())
            return layout;
        failures.clear();
    }
    AtlasLayout layout = makeLayout(build, failures);
    writeAtlasLayout(build.layout, layout);
    return layout;
}

} // namespace

int runShard(BuildConfig build, const Arguments& arguments)
{
    if (build.output != Output::Pack || !build.updatable)
        throw UsageError("--shard builds packed stores with their .mips; leave out --output and "
                         "--not-updatable");
    const TileShard shard = shardOf(arguments.get("--shard", ""));
    std::vector<std::string> failures;
    const AtlasLayout layout = sharedLayout(build, failures);
    chooseChannels(build, layout);
    TilePackWriter::Options options;
    options.durable = build.durable;
    const TileBuildReport report =
        buildTileShard(build.store, shard, layout, originOf(build, layout), options);
    for (const PhotoFailure& failure : report.failures)
        failures.push_back(failure.cause);
    if (!report.failures.empty())
    {
        const AtlasLock lock(build.layout, 60.0); // of other shards
        AtlasLayout shared = readAtlasLayout(build.layout);
        addPending(shared, report.failures);
        writeAtlasLayout(build.layout, shared);
    }
    const std::string path = shard.path(build.store);
    if (arguments.isJson())
        print({{"store", build.store},
               {"shard", path},
               {"encodedTiles", report.encodedTiles},
               {"uniformTiles", report.uniformTiles},
               {"tileBytes", report.tileBytes},
               {"failures", failures}});
    else
        std::printf("%s: %s tiles, %s\n", path.c_str(), grouped(report.encodedTiles).c_str(),
                    byteText(report.tileBytes).c_str());
    for (const std::string& failure : failures)
        std::fprintf(stderr, "osgtilestore build: %s\n", failure.c_str());
    return failures.empty() ? 0 : 1;
}

} // namespace tilestore
