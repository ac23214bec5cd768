// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileBuilder.h>

#include <osgPagedTexture/TileEncoder.h>
#include <osgPagedTexture/TileWalk.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace osgPagedTexture
{

namespace
{

using Kind = TileStoreError::Kind;

[[noreturn]] void refuse(const std::string& what)
{
    throw TileStoreError(Kind::Refused, "osgPagedTexture::TileBuilder: " + what);
}

void checkSettings(const TileBuildSettings& settings)
{
    if (settings.channels != 1 && settings.channels != 3 && settings.channels != 4)
    {
        refuse("tiles have 1, 3 or 4 channels, not " + std::to_string(settings.channels));
    }
    if (settings.channels == 4 && !settings.format.keepsAlpha())
    {
        refuse("tiles with alpha need a format that has it; choose png, bc3 or bc7");
    }
    if (settings.format.quality < 1 || settings.format.quality > 100 ||
        settings.format.compression < 0 || settings.format.compression > 9)
    {
        refuse("the quality of JPEG is 1 to 100, the compression of PNG 0 to 9");
    }
}

TileFormat keptFormat()
{
    TileFormat format;
    format.coding = TileCoding::Png;
    format.compression = 1;
    return format;
}

void count(TileBuildReport& report, const TileData& tile)
{
    report.encodedTiles += tile.kind == TileData::Kind::Encoded;
    report.uniformTiles += tile.kind == TileData::Kind::Uniform;
    report.absentTiles += tile.kind == TileData::Kind::None;
    report.tileBytes += tile.bytes.size();
}

std::int64_t alignedDown(std::int64_t value, int bits)
{
    return value >> bits << bits;
}

std::int64_t alignedUp(std::int64_t value, int bits)
{
    return alignedDown(value + (std::int64_t(1) << bits) - 1, bits);
}

} // namespace

struct TileBuilder::Content
{
    Content(const AtlasLayout& newLayout, const std::string& newFolder,
            const TileBuildSettings& newSettings)
        : layout(newLayout), folder(newFolder), settings(newSettings),
          grid(layout.width, layout.height, settings.tileSide, settings.border, settings.edge),
          team(settings.threads), encoder(makeTileEncoder(settings.format)),
          keptEncoder(makeTileEncoder(keptFormat()))
    {
    }

    WalkSettings walkSettings(int levels, const PixelRect& window) const;
    void checkMemory(const WalkSettings& walk) const;
    PixelRect windowOf(const std::vector<TileRange>& touched, const PixelRect& changed,
                       int levels) const;

    const AtlasLayout& layout;
    const std::string folder;
    const TileBuildSettings settings;
    const TileGrid grid;
    CoreTeam team;
    const std::unique_ptr<TileEncoder> encoder, keptEncoder;
};

WalkSettings TileBuilder::Content::walkSettings(int levels, const PixelRect& window) const
{
    WalkSettings walk;
    walk.folder = folder;
    walk.window = window;
    walk.levels = levels;
    walk.bandRows = grid.getPayload();
    walk.border = grid.getBorder();
    walk.channels = settings.channels;
    walk.linearLight = settings.linearLight;
    walk.background = settings.background;
    walk.cut = settings.lossless;
    return walk;
}

void TileBuilder::Content::checkMemory(const WalkSettings& walk) const
{
    const std::uint64_t bytes = TileWalk::getRowBytes(walk);
    if (bytes > settings.maxBytes)
    {
        constexpr std::uint64_t KiB = 1 << 10, MiB = 1 << 20;
        const std::string allowed = settings.maxBytes < MiB
                                        ? std::to_string(settings.maxBytes / KiB) + " KiB"
                                        : std::to_string(settings.maxBytes / MiB) + " MiB";
        refuse("an atlas " + std::to_string(walk.window.width) + " pixels wide takes " +
               std::to_string(bytes / MiB + 1) + " MiB of rows, more than the " + allowed +
               " allowed; allow more memory, lay it out narrower or make the tiles smaller");
    }
}

/// All pixels of level 0 that the touched tiles and the changed pixels of the last level come of.
PixelRect TileBuilder::Content::windowOf(const std::vector<TileRange>& touched,
                                         const PixelRect& changed, int levels) const
{
    std::int64_t left = changed.x, top = changed.y;
    std::int64_t right = changed.x + changed.width, bottom = changed.y + changed.height;
    for (const TileRange& range : touched)
    {
        const PixelRect first = grid.getPixels({range.level, range.x, range.y});
        const PixelRect last = grid.getPixels({range.level, range.lastX, range.lastY});
        const std::int64_t scale = std::int64_t(1) << range.level;
        left = std::min(left, first.x * scale);
        top = std::min(top, first.y * scale);
        right = std::max(right, (last.x + last.width) * scale);
        bottom = std::max(bottom, (last.y + last.height) * scale);
    }
    const std::int64_t x = std::max<std::int64_t>(alignedDown(left, levels - 1), 0);
    const std::int64_t y = std::max<std::int64_t>(alignedDown(top, levels - 1), 0);
    return {x, y, std::min(alignedUp(right, levels - 1), grid.getWidth()) - x,
            std::min(alignedUp(bottom, levels - 1), grid.getHeight()) - y};
}

TileBuilder::TileBuilder(const AtlasLayout& layout, const std::string& folder,
                         const TileBuildSettings& settings)
{
    checkSettings(settings);
    checkAtlas(layout);
    _content = std::make_unique<Content>(layout, folder, settings);
}

TileBuilder::~TileBuilder() = default;

const TileGrid& TileBuilder::getGrid() const
{
    return _content->grid;
}

bool TileBuilder::getKeptSettings(TileStoreSettings& settings) const
{
    const TileGrid& grid = _content->grid;
    if (grid.getLevels() <= KeptLevel)
    {
        return false;
    }
    settings = TileStoreSettings();
    settings.grid = TileGrid(grid.getWidth(KeptLevel), grid.getHeight(KeptLevel), grid.getPayload(),
                             0, TileGrid::Edge::Padded);
    settings.format = keptFormat().extension();
    return true;
}

TileBuildReport TileBuilder::build(TileWriter& store, TileWriter* kept, const Progress& progress)
{
    const TileGrid& grid = _content->grid;
    const WalkSettings walk =
        _content->walkSettings(grid.getLevels(), {0, 0, grid.getWidth(), grid.getHeight()});
    _content->checkMemory(walk);
    TileBuildReport report;
    std::vector<WalkOutput> outputs;
    outputs.push_back({grid, 0, WalkOutput::everything(grid), _content->settings.format,
                       [&](const TileKey& key, const TileData& tile)
                       {
                           count(report, tile);
                           if (tile.kind != TileData::Kind::None)
                           {
                               store.put(key, tile);
                           }
                           else if (_content->settings.everyTile)
                           {
                               store.put(key, TileData::uniform(_content->settings.background));
                           }
                       }});
    TileStoreSettings keptSettings;
    if (kept && getKeptSettings(keptSettings))
    {
        outputs.push_back({keptSettings.grid, KeptLevel, WalkOutput::everything(keptSettings.grid),
                           keptFormat(),
                           [&](const TileKey& key, const TileData& tile)
                           {
                               if (tile.kind != TileData::Kind::None)
                               {
                                   kept->put(key, tile);
                               }
                           }});
    }
    TileWalk tileWalk(_content->layout, walk, std::move(outputs), _content->team);
    tileWalk.progress = [&](std::int64_t rows)
    {
        if (progress)
        {
            progress(std::uint64_t(rows), std::uint64_t(grid.getHeight()));
        }
    };
    tileWalk.run();
    report.failures = tileWalk.getFailures();
    return report;
}

TileBuildReport TileBuilder::rebuild(const PixelRect& changed, const Put& put, LevelPixels& coarse)
{
    const TileGrid& grid = _content->grid;
    const int levels = std::min(grid.getLevels(), KeptLevel + 1);
    const bool hasCoarse = levels > KeptLevel;
    std::vector<TileRange> touched;
    for (int level = 0; level < levels - (hasCoarse ? 1 : 0); ++level)
    {
        touched.push_back(grid.getTouched(changed, level));
    }
    coarse = LevelPixels();
    TileBuildReport report;
    if (touched[0].lastX < touched[0].x)
    {
        return report;
    }
    const PixelRect inside{
        std::max<std::int64_t>(changed.x, 0), std::max<std::int64_t>(changed.y, 0),
        std::min(changed.x + changed.width, grid.getWidth()) - std::max<std::int64_t>(changed.x, 0),
        std::min(changed.y + changed.height, grid.getHeight()) -
            std::max<std::int64_t>(changed.y, 0)};
    const WalkSettings walk =
        _content->walkSettings(levels, _content->windowOf(touched, inside, levels));
    _content->checkMemory(walk);
    TileWalk tileWalk(_content->layout, walk,
                      {{grid, 0, touched, _content->settings.format,
                        [&](const TileKey& key, const TileData& tile)
                        {
                            count(report, tile);
                            put(key, tile);
                        }}},
                      _content->team);
    if (hasCoarse)
    {
        const std::int64_t x = inside.x >> KeptLevel, y = inside.y >> KeptLevel;
        coarse.level = KeptLevel;
        coarse.area = {x, y, ((inside.x + inside.width - 1) >> KeptLevel) + 1 - x,
                       ((inside.y + inside.height - 1) >> KeptLevel) + 1 - y};
        tileWalk.lastLevelRow = [&](std::int64_t row, const std::uint8_t* pixels)
        {
            if (row >= y && row < y + coarse.area.height)
            {
                const std::int64_t skipped = x - (walk.window.x >> KeptLevel);
                const std::uint8_t* from = pixels + skipped * walk.channels;
                coarse.bytes.insert(coarse.bytes.end(), from,
                                    from + coarse.area.width * walk.channels);
            }
        };
    }
    tileWalk.run();
    report.failures = tileWalk.getFailures();
    return report;
}

TileData TileBuilder::encode(const std::uint8_t* const* rows, int width, int height, bool kept)
{
    return makeTile({rows, width, height, _content->settings.channels},
                    kept ? *_content->keptEncoder : *_content->encoder);
}

void addPending(AtlasLayout& layout, const std::vector<PhotoFailure>& failures)
{
    for (const PhotoFailure& failure : failures)
    {
        const PixelRect covered = layout.getCovered(layout.photos[failure.photo]);
        const auto isSame = [&](const PixelRect& other)
        {
            return std::tie(other.x, other.y, other.width, other.height) ==
                   std::tie(covered.x, covered.y, covered.width, covered.height);
        };
        if (std::none_of(layout.pending.begin(), layout.pending.end(), isSame))
        {
            layout.pending.push_back(covered);
        }
    }
}

} // namespace osgPagedTexture
