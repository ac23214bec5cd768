// SPDX-License-Identifier: MIT
#include "BuildConfig.h"
#include "BuildShard.h"
#include "Progress.h"
#include "Subcommand.h"

#include <osgPagedTexture/AtlasPicture.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/PhotoFolder.h>
#include <osgPagedTexture/TileFolders.h>
#include <osgPagedTexture/TilePack.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace tilestore
{

namespace fs = std::filesystem;

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore build CONFIG|FOLDER|LAYOUT [options]
Lays the photographs of a folder and its subfolders out in one large picture, which is never
written, and makes the tiles of all its levels: the store. Beside it lies STORE.layout.json, which
says where each photograph is; given as LAYOUT it leads to the same store again. For later updates
STORE.mips keeps pixels of the coarse levels without loss.

CONFIG is a JSON file. Its members are named in brackets; options go before them. Paths in it are
relative to it:  { "photos": "pictures", "store": "monument.tiles", "quality": 90 }

  --photos FOLDER        [photos] JPEG, PNG, TIFF, PPM and what else OpenImageIO reads
  --store FILE           [store] default: the folder's or file's name and .tiles or .dzi
  --output KIND          [output] pack: one file (default); libvt: a folder as LibVT reads it;
                         deepzoom: a .dzi file and its folder, as viewers in the web read it
  --tile-side N          [tileSide] in pixels with borders; default 256
  --border N             [border] pixels of the neighbours on each side; default 8, deepzoom 0
  --format F             [format] jpg (default), png, bc1, bc3, bc7 (in .dds files)
  --quality N            [quality] of jpg, 1 to 100; default 85
  --subsampling S        [subsampling] of the colours of jpg: 4:2:0 (default), 4:2:2, 4:4:4
  --compression N        [compression] of png, 0 to 9; default 6
  --block-quality Q      [blockQuality] of bc1, bc3, bc7: fast, normal (default), fine, best
  --channels N           [channels] 1 grey, 3, 4 with alpha; default 3, and 4 where a photograph
                         has alpha and the format, too
  --filter F             [filter] linear: coarser levels average light (default); plain: code
                         values, as most programs do
  --background R,G,B     [background] where there is no photograph; default 255,255,255,
                         and transparent where tiles have alpha
  --lossless             [lossless] tiles of level 0 that lie in one JPEG are cut out of it without
                         loss, of its own quality; where tile side - 2 * border is a multiple of 16
  --atlas FILE           [atlas] also writes the large picture, .ppm, .tif, .png: for other programs
  --atlas-side N         [atlasSide] of the largest part of it, FILE_<x>_<y>; default 65500
  --padding N            [padding] pixels around photographs that repeat their edge; default 12
  --max-width N          [maxWidth] of the picture that they are laid out in
  --memory SIZE          [memory] for rows of it, such as 512MiB; default 1GiB. The layout gets
                         as narrow as that takes. The program itself needs some 30 MiB besides,
                         progressive JPEGs 3 bytes a pixel while rows cross them
  --threads N            [threads] default: as many as the machine has cores
  --not-updatable        [notUpdatable] writes no STORE.mips
  --no-sync              [noSync] does not wait for the disk
  --shard I/N            builds part I of N, 1 to N, for N processes on any machines that share the
                         folder; then: osgtilestore merge STORE
  --json                 what was made
  --help                 this text

A photograph that is broken is named, the rest is built, and the exit status is 1.
)";

/// What happened, for people and for --json.
struct Outcome
{
    AtlasLayout layout;
    std::vector<std::string> failures;
    TileBuildReport report;
    TileStoreSettings settings;
    std::vector<std::string> atlas; ///< Its files.
    double layoutSeconds = 0.0, atlasSeconds = 0.0, buildSeconds = 0.0;
};

class Stopwatch
{
public:
    double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - _start).count();
    }

private:
    const std::chrono::steady_clock::time_point _start = std::chrono::steady_clock::now();
};

std::string folderOf(const std::string& file)
{
    const std::string folder = fs::path(file).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// The widest atlas whose rows take half of the memory.
std::int64_t widestLayout(const BuildConfig& build)
{
    const std::uint64_t side = std::uint64_t(build.settings.tileSide);
    const std::uint64_t rows = 5 * side; // of level 0 in all: see TileBuilder
    const std::uint64_t widest =
        build.settings.maxBytes / (rows * std::uint64_t(build.settings.channels));
    const auto width = std::int64_t(std::max(widest, side));
    return build.maxWidth > 0 ? std::min(build.maxWidth, width) : width;
}

} // namespace

AtlasLayout makeLayout(const BuildConfig& build, std::vector<std::string>& failures)
{
    const std::string folder = folderOf(build.layout);
    std::vector<std::string> paths;
    for (const std::string& path : findPhotos(build.photos))
        paths.push_back(fs::relative(fs::path(build.photos) / path, folder).generic_string());
    if (paths.empty())
        throw std::runtime_error("no photograph is in '" + build.photos +
                                 "'; name a folder of JPEG, PNG or TIFF files");
    Progress progress("reading photographs", "photographs");
    DescribedPhotos described = describePhotos(folder, paths, build.settings.threads,
                                               [&](std::uint64_t done, std::uint64_t total)
                                               { progress.show(done, total); });
    for (const DescribedPhotos::Failure& failure : described.failures)
        failures.push_back(failure.cause);
    if (described.photos.empty())
        throw std::runtime_error(failures.front() + "; no photograph is left");
    AtlasSettings settings =
        AtlasSettings::forTiles(build.settings.tileSide, build.settings.border);
    settings.maxWidth = widestLayout(build);
    if (build.padding >= 0)
        settings.padding = build.padding;
    AtlasLayout layout = packAtlas(std::move(described.photos), settings);
    layout.photoFolder = fs::relative(build.photos, folder).generic_string();
    return layout;
}

namespace
{

/// Whether a photograph has alpha that shows.
bool isTranslucent(const BuildConfig& build, const AtlasPhoto& photo)
{
    const std::string extension = fs::path(photo.path).extension().string();
    if (extension == ".jpg" || extension == ".jpeg" || extension == ".JPG") // has none
        return false;
    try
    {
        return readImageInfo(folderOf(build.layout) + "/" + photo.path).translucent;
    }
    catch (const ImageError&) // the builder tells
    {
        return false;
    }
}

/// Says what tiles without alpha lose of photographs that have it.
void warnOfLostAlpha(const BuildConfig& build, const AtlasLayout& layout)
{
    if (build.channelsGiven || build.settings.format.keepsAlpha())
        return;
    const auto count =
        std::count_if(layout.photos.begin(), layout.photos.end(),
                      [&](const AtlasPhoto& photo) { return isTranslucent(build, photo); });
    if (count > 0)
        std::fprintf(stderr,
                     "osgtilestore build: %s of %s photographs have alpha, which these tiles do "
                     "not keep: what is transparent shows; --format png, bc3 or bc7 keeps it\n",
                     grouped(std::uint64_t(count)).c_str(), grouped(layout.photos.size()).c_str());
}

} // namespace

void chooseChannels(BuildConfig& build, const AtlasLayout& layout)
{
    const bool mayHaveAlpha = !build.channelsGiven && build.settings.format.keepsAlpha();
    if (mayHaveAlpha &&
        std::any_of(layout.photos.begin(), layout.photos.end(),
                    [&](const AtlasPhoto& photo) { return isTranslucent(build, photo); }))
        build.settings.channels = 4;
    // Else coarse levels would have an opaque rim around what is transparent.
    if (build.settings.channels == 4 && !build.backgroundGiven)
        build.settings.background[3] = 0;
}

TileStoreOrigin originOf(const BuildConfig& build, const AtlasLayout& layout)
{
    return {build.settings, fs::path(build.layout).filename().string(), layout.getContentHash()};
}

namespace
{

std::unique_ptr<TileWriter> openWriter(const BuildConfig& build, const std::string& path,
                                       const TileStoreSettings& settings)
{
    if (build.output == Output::Pack)
    {
        TilePackWriter::Options options;
        options.durable = build.durable;
        return std::make_unique<TilePackWriter>(path, settings, options);
    }
    return std::make_unique<TileFolderWriter>(
        path, build.output == Output::LibVT ? FolderLayout::LibVT : FolderLayout::DeepZoom,
        settings, makeUniformEncoder(build.settings.format, build.settings.channels));
}

void buildStore(const BuildConfig& build, Outcome& outcome)
{
    TileBuilder builder(outcome.layout, folderOf(build.layout), build.settings);
    TileStoreSettings& settings = outcome.settings;
    settings.grid = builder.getGrid();
    settings.format = build.settings.format.extension();
    settings.description = originOf(build, outcome.layout).text();
    TileStoreSettings keptSettings;
    std::unique_ptr<TileWriter> kept;
    const std::string keptPath = build.store + ".mips";
    if (build.updatable && builder.getKeptSettings(keptSettings))
    {
        keptSettings.description = settings.description;
        kept = openWriter(build, keptPath, keptSettings);
    }
    const auto store = openWriter(build, build.store, settings);
    Progress progress("building", "rows");
    outcome.report =
        builder.build(*store, kept.get(),
                      [&](std::uint64_t done, std::uint64_t total) { progress.show(done, total); });
    for (const PhotoFailure& failure : outcome.report.failures)
        outcome.failures.push_back(failure.cause);
    if (kept)
        kept->commit();
    else if (build.output == Output::Pack)
        fs::remove(keptPath); // of an earlier build: its pixels would spoil an update
    store->commit();
}

void writePictures(const BuildConfig& build, Outcome& outcome)
{
    AtlasPictureSettings settings;
    settings.path = build.atlas;
    settings.partSide = build.atlasSide;
    settings.channels = build.settings.channels;
    settings.background = build.settings.background;
    settings.threads = build.settings.threads;
    Progress progress("writing the atlas", "rows");
    outcome.atlas =
        writeAtlas(outcome.layout, folderOf(build.layout), settings,
                   {0, 0, outcome.layout.width, outcome.layout.height},
                   [&](std::uint64_t done, std::uint64_t total) { progress.show(done, total); })
            .files; // what is broken the tiles tell as well
}

Json toJson(const BuildConfig& build, const Outcome& outcome)
{
    Json json;
    json["store"] = build.store;
    json["layout"] = build.layout;
    json["width"] = outcome.layout.width;
    json["height"] = outcome.layout.height;
    json["photographs"] = outcome.layout.photos.size();
    json["occupied"] = outcome.layout.getOccupiedShare();
    json["levels"] = outcome.settings.grid.getLevels();
    json["encodedTiles"] = outcome.report.encodedTiles;
    json["uniformTiles"] = outcome.report.uniformTiles;
    json["absentTiles"] = outcome.report.absentTiles;
    json["tileBytes"] = outcome.report.tileBytes;
    json["layoutSeconds"] = outcome.layoutSeconds;
    if (!outcome.atlas.empty())
    {
        json["atlas"] = outcome.atlas;
        json["atlasSeconds"] = outcome.atlasSeconds;
    }
    json["buildSeconds"] = outcome.buildSeconds;
    json["failures"] = outcome.failures;
    return json;
}

void printText(const Json& json)
{
    const auto count = [&](const char* name) { return grouped(json[name].get<std::uint64_t>()); };
    std::printf("%s: %s photographs on %s x %s pixels, %.0f %% occupied, %d levels\n",
                json["store"].get<std::string>().c_str(), count("photographs").c_str(),
                count("width").c_str(), count("height").c_str(),
                100.0 * json["occupied"].get<double>(), json["levels"].get<int>());
    std::printf("%s tiles, %s; %s of one colour, %s of nothing; %.1f s for the layout, %.1f s "
                "for the tiles\n",
                count("encodedTiles").c_str(),
                byteText(json["tileBytes"].get<std::uint64_t>()).c_str(),
                count("uniformTiles").c_str(), count("absentTiles").c_str(),
                json["layoutSeconds"].get<double>(), json["buildSeconds"].get<double>());
}

OptionList withShard(OptionList options)
{
    options.push_back({"--shard"});
    return options;
}

int run(const Arguments& arguments)
{
    BuildConfig build = readBuildConfig(arguments);
    if (arguments.has("--shard"))
        return runShard(build, arguments);
    const AtlasLock lock(build.layout);
    Outcome outcome;
    const Stopwatch layoutTime;
    outcome.layout =
        build.makeLayout ? makeLayout(build, outcome.failures) : readAtlasLayout(build.layout);
    if (build.makeLayout)
        writeAtlasLayout(build.layout, outcome.layout);
    chooseChannels(build, outcome.layout);
    warnOfLostAlpha(build, outcome.layout);
    outcome.layoutSeconds = layoutTime.seconds();
    if (!build.atlas.empty())
    {
        const Stopwatch atlasTime;
        writePictures(build, outcome);
        outcome.atlasSeconds = atlasTime.seconds();
    }
    const Stopwatch buildTime;
    buildStore(build, outcome);
    outcome.buildSeconds = buildTime.seconds();
    if (!outcome.layout.pending.empty() || !outcome.report.failures.empty())
    {
        outcome.layout.pending.clear();
        addPending(outcome.layout, outcome.report.failures);
        writeAtlasLayout(build.layout, outcome.layout);
    }

    const Json json = toJson(build, outcome);
    if (arguments.isJson())
        print(json);
    else
        printText(json);
    for (const std::string& failure : outcome.failures)
        std::fprintf(stderr, "osgtilestore build: %s\n", failure.c_str());
    return outcome.failures.empty() ? 0 : 1;
}

} // namespace

const Subcommand BuildCommand{"build", "a store from photographs", Help, withShard(buildOptions()),
                              run};

} // namespace tilestore
