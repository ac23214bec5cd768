// SPDX-License-Identifier: MIT
#include "PackOptions.h"
#include "Subcommand.h"

#include <osgPagedTexture/AtlasPicture.h>
#include <osgPagedTexture/AtlasWatch.h>
#include <osgPagedTexture/TileUpdate.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <set>
#include <thread>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr char Help[] =
    R"(osgtilestore update STORE [options]
Brings a packed store up to date with the photographs it was built from: those that have changed,
moved to another name, come into their folder or gone since. Only the tiles that show a changed
pixel are made again, each byte for byte as a full build from the same layout makes it. Photographs
keep their places in STORE.layout.json; new ones get free places, or enlarge the picture below.
Killed at any moment the store is the old or the new one, and the next update does the rest.

  --watch            goes on, and updates whenever photographs have changed; compacts the store
                     when more than 30 % of its file is dead; ends with Ctrl-C. Photographs that
                     are missing keep their tiles
  --interval S       seconds between two looks of --watch, 1 to 86400; default 1
  --keep-missing     photographs that are not there keep their tiles
  --look-inside      compares the content of all photographs, not only of those with another size
                     or time
  --atlas FILE       also the large picture that build --atlas FILE has written: its parts that
                     show a changed pixel are written again
  --atlas-side N     of its largest part, as for build; default 65500
  --memory SIZE      for the rows in the making, such as 512MiB; default 1GiB
  --threads N        default: as many as the machine has cores
  --wait S           seconds to wait for another program that updates the store; default 0
  --no-sync          does not wait for the disk
  --json             what was done; with --watch one line each time
  --help             this text

A photograph that cannot be read is named, the rest is done, and the exit status is 1.
)";

volatile std::sig_atomic_t g_stop = 0;

void stop(int)
{
    g_stop = 1;
}

/// The parts of the large picture that show anything of what is pending.
void writeParts(const AtlasLayout& layout, const std::string& folder,
                const AtlasPictureSettings& settings)
{
    std::set<std::pair<std::int64_t, std::int64_t>> parts;
    for (const PixelRect& rect : layout.pending)
    {
        const std::int64_t right = std::min(rect.x + rect.width, layout.width) - 1;
        const std::int64_t bottom = std::min(rect.y + rect.height, layout.height) - 1;
        for (std::int64_t y = rect.y / settings.partSide; y <= bottom / settings.partSide; ++y)
            for (std::int64_t x = rect.x / settings.partSide; x <= right / settings.partSide; ++x)
                parts.insert({y, x});
    }
    for (const auto& [y, x] : parts)
        writeAtlas(layout, folder, settings, {x * settings.partSide, y * settings.partSide, 1, 1});
}

AtlasPictureSettings pictureOf(const std::string& store, const Arguments& arguments)
{
    const TileBuildSettings built =
        TileStoreOrigin::parse(TilePackReader(store).getSettings().description).settings;
    AtlasPictureSettings settings;
    settings.path = arguments.get("--atlas", "");
    settings.partSide =
        arguments.number("--atlas-side", settings.partSide, 1, std::int64_t(1) << 30);
    settings.channels = built.channels;
    settings.background = built.background;
    settings.threads = unsigned(arguments.number("--threads", 0, 0, 1024));
    return settings;
}

TileUpdateSettings settingsOf(const Arguments& arguments)
{
    TileUpdateSettings settings;
    settings.lookInside = arguments.has("--look-inside");
    settings.keepMissing = arguments.has("--keep-missing") || arguments.has("--watch");
    settings.threads = unsigned(arguments.number("--threads", 0, 0, 1024));
    settings.maxBytes = arguments.bytes("--memory", settings.maxBytes);
    settings.pack = packOptionsOf(arguments);
    return settings;
}

void report(const std::string& path, const TileUpdateReport& done, double seconds,
            const Arguments& arguments)
{
    if (arguments.isJson())
    {
        const Json json = {{"store", path},
                           {"changed", done.changed},
                           {"added", done.added},
                           {"removed", done.removed},
                           {"moved", done.moved},
                           {"touchedTiles", done.touchedTiles},
                           {"changedTiles", done.changedTiles},
                           {"rebuilt", done.rebuilt},
                           {"notes", done.notes},
                           {"failures", done.failures},
                           {"seconds", seconds}};
        if (arguments.has("--watch"))
            std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
        else
            print(json);
    }
    else if (done.isNothing())
        std::printf("%s: up to date\n", path.c_str());
    else
        std::printf("%s: %s changed, %s added, %s removed, %s moved; %s tiles made, %s are new; "
                    "%.2f s\n",
                    path.c_str(), grouped(done.changed).c_str(), grouped(done.added).c_str(),
                    grouped(done.removed).c_str(), grouped(done.moved).c_str(),
                    grouped(done.touchedTiles).c_str(), grouped(done.changedTiles).c_str(),
                    seconds);
    std::fflush(stdout);
    if (!done.rebuilt.empty())
        std::fprintf(stderr, "osgtilestore update: the whole store was built anew: %s\n",
                     done.rebuilt.c_str());
    for (const auto* lines : {&done.notes, &done.failures})
        for (const std::string& line : *lines)
            std::fprintf(stderr, "osgtilestore update: %s\n", line.c_str());
}

bool updateOnce(const std::string& path, const Arguments& arguments)
{
    const auto start = Clock::now();
    TileUpdateSettings settings = settingsOf(arguments);
    if (arguments.has("--atlas"))
        settings.afterwards = [picture = pictureOf(path, arguments)](const AtlasLayout& layout,
                                                                     const std::string& folder)
        { writeParts(layout, folder, picture); };
    const TileUpdateReport done = updateTileStore(path, settings);
    report(path, done, std::chrono::duration<double>(Clock::now() - start).count(), arguments);
    return done.failures.empty();
}

void compactWhereDead(const std::string& path, const Arguments& arguments)
{
    for (const std::string& each : {path, keptPathOf(path)})
        if (fs::exists(each) && TilePackReader(each).getInfo().getDeadShare() > 0.3)
            compactTilePack(each, settingsOf(arguments).pack);
}

AtlasWatch watchOf(const std::string& path)
{
    const auto origin = TileStoreOrigin::parse(TilePackReader(path).getSettings().description);
    const std::string folder = fs::path(path).parent_path().string();
    return AtlasWatch(readAtlasLayout((fs::path(folder) / origin.layout).string()), folder);
}

/// Waits, but not for a signal's end.
void rest(double seconds)
{
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!g_stop && Clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

/// False where it may go well later: another program writes the store, or the disk is full.
bool tryUpdate(const std::string& path, const Arguments& arguments)
{
    static std::string lastError;
    try
    {
        updateOnce(path, arguments);
        compactWhereDead(path, arguments);
        lastError.clear();
        return true;
    }
    catch (const TileStoreError& error)
    {
        if (lastError != error.what())
            std::fprintf(stderr, "osgtilestore update: %s\n", error.what());
        lastError = error.what();
        return false;
    }
}

int keepUpdating(const std::string& path, const Arguments& arguments)
{
    const double interval = double(arguments.number("--interval", 1, 1, 86400));
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    // The watch looks first, so that what changes while the store is updated counts.
    AtlasWatch watch = watchOf(path);
    updateOnce(path, arguments);
    bool due = false;
    while (!g_stop)
    {
        const auto start = Clock::now();
        due = watch.look() || due;
        // A million photographs take seconds to look at: never more than a tenth of the time.
        const double looked = std::chrono::duration<double>(Clock::now() - start).count();
        if (due)
            due = !tryUpdate(path, arguments);
        rest(std::max(interval, 10.0 * looked));
    }
    return 0;
}

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "STORE")[0];
    if (arguments.has("--watch"))
        return keepUpdating(path, arguments);
    return updateOnce(path, arguments) ? 0 : 1;
}

} // namespace

const Subcommand UpdateCommand{"update",
                               "the tiles of changed photographs",
                               Help,
                               {{"--watch", false},
                                {"--interval"},
                                {"--keep-missing", false},
                                {"--look-inside", false},
                                {"--atlas"},
                                {"--atlas-side"},
                                {"--memory"},
                                {"--threads"},
                                {"--wait"},
                                {"--no-sync", false}},
                               run};

} // namespace tilestore
