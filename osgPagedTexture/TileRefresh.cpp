// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileRefresh.h>

#include <algorithm>
#include <filesystem>

namespace osgPagedTexture
{

namespace
{

/// Puts a packed store's tiles into one of another size, as far as they are the same there.
void moveToGrid(const std::string& path, const TileGrid& grid,
                const TilePackWriter::Options& options)
{
    const TilePackReader before(path);
    if (before.getSettings().grid != grid)
    {
        TileStoreSettings settings = before.getSettings();
        settings.grid = grid;
        TilePackWriter writer(path, settings, options);
        copyTiles(before, writer);
        writer.commit();
    }
}

std::string folderOf(const std::string& path)
{
    return std::filesystem::path(path).parent_path().string();
}

/// Whether two stores were built in the same way, whatever from.
bool alike(const std::string& description, const TileStoreOrigin& origin)
{
    try
    {
        TileStoreOrigin other = TileStoreOrigin::parse(description);
        other.layoutHash = origin.layoutHash;
        return other.text() == origin.text();
    }
    catch (const TileStoreError&)
    {
        return false;
    }
}

} // namespace

TileRefresh::TileRefresh(const std::string& path, const AtlasLayout& layout,
                         const TileStoreOrigin& origin, const TilePackWriter::Options& options)
    : _path(path), _layout(layout), _origin(origin), _options(options),
      _builder(layout, folderOf(path), origin.settings), _occupancy(layout), _before(path)
{
}

std::string TileRefresh::whyImpossible() const
{
    TileStoreSettings kept;
    if (!_builder.getKeptSettings(kept))
    {
        return {};
    }
    const std::string keptPath = keptPathOf(_path);
    if (!std::filesystem::exists(keptPath))
    {
        return "'" + keptPath + "' is not there";
    }
    try
    {
        const TilePackReader reader(keptPath);
        const TileGrid& grid = reader.getSettings().grid;
        if (!alike(reader.getSettings().description, _origin) ||
            grid.getTileSide() != kept.grid.getTileSide() || grid.getBorder() != 0 ||
            grid.getWidth() > kept.grid.getWidth() || grid.getHeight() > kept.grid.getHeight())
        {
            return "'" + keptPath + "' belongs to another store";
        }
    }
    catch (const TileStoreError& error)
    {
        return error.what();
    }
    return {};
}

double TileRefresh::getShare() const
{
    double tiles = 0.0;
    for (const PixelRect& part : _layout.pending)
    {
        const TileRange range = _builder.getGrid().getTouched(part, 0);
        tiles += double(range.lastX - range.x + 1) * double(range.lastY - range.y + 1);
    }
    return tiles / double(_builder.getGrid().getTileCount(0));
}

void TileRefresh::openWriter()
{
    TileStoreSettings settings = _before.getSettings();
    const bool sameGrid = settings.grid == _builder.getGrid();
    settings.grid = _builder.getGrid();
    settings.description = _origin.text();
    if (sameGrid)
    {
        _writer = std::make_unique<TilePackWriter>(_path, _options);
        _writer->setDescription(settings.description);
    }
    else
    {
        _writer = std::make_unique<TilePackWriter>(_path, settings, _options);
        copyTiles(_before, *_writer);
    }
}

/// Whether a tile is not made yet: it may show pixels of several parts.
bool TileRefresh::isNext(const TileKey& key)
{
    // Beyond this many some are made twice, which changes nothing.
    constexpr std::size_t maxRemembered = 1000000;
    if (_done.size() >= maxRemembered)
    {
        _done.clear();
    }
    return _done.insert({key.level, key.y, key.x}).second;
}

void TileRefresh::put(const TileKey& key, const TileData& tile, TileUpdateReport& report)
{
    ++report.touchedTiles;
    if (!(_before.read(key) == tile))
    {
        ++report.changedTiles;
        _writer->put(key, tile);
    }
}

/// The levels below the kept ones, and the kept pixels.
void TileRefresh::refreshFine(const PixelRect& part, TileUpdateReport& report)
{
    LevelPixels coarse;
    const TileBuildReport built = _builder.rebuild(
        part,
        [&](const TileKey& key, const TileData& tile)
        {
            if (isNext(key))
            {
                put(key, tile, report);
            }
        },
        coarse);
    for (const PhotoFailure& failure : built.failures)
    {
        const auto isSame = [&](const PhotoFailure& known) { return known.photo == failure.photo; };
        if (std::none_of(_unread.begin(), _unread.end(), isSame))
        {
            _unread.push_back(failure);
        }
    }
    if (_kept && !coarse.bytes.empty())
    {
        _kept->write(0, coarse.area, coarse.bytes.data());
        _kept->makeCoarser(0, coarse.area);
    }
}

/// The kept levels' tiles that show any of these pixels of level 0.
void TileRefresh::refreshCoarse(const PixelRect& part, int level, TileUpdateReport& report)
{
    const TileRange range = _builder.getGrid().getTouched(part, level);
    for (std::int64_t y = range.y; y <= range.lastY; ++y)
    {
        for (std::int64_t x = range.x; x <= range.lastX; ++x)
        {
            const TileKey key{level, x, y};
            if (isNext(key))
            {
                put(key, _kept->makeTile(key), report);
            }
        }
    }
}

void TileRefresh::refreshCoarse(TileUpdateReport& report)
{
    // A grown atlas may have levels that were not there.
    const TileGrid& grid = _builder.getGrid();
    const int former = _before.getSettings().grid.getLevels();
    if (former < grid.getLevels())
    {
        const int last = std::max(former - 1 - TileBuilder::KeptLevel, 0);
        _kept->makeCoarser(
            last, {0, 0, _kept->getGrid().getWidth(last), _kept->getGrid().getHeight(last)});
    }
    for (int level = TileBuilder::KeptLevel; level < grid.getLevels(); ++level)
    {
        for (const PixelRect& part : _layout.pending)
        {
            refreshCoarse(part, level, report);
        }
        if (level >= former)
        {
            refreshCoarse({0, 0, grid.getWidth(), grid.getHeight()}, level, report);
        }
    }
    _kept->commit(_origin.text());
}

void TileRefresh::run(TileUpdateReport& report)
{
    TileStoreSettings kept;
    if (_builder.getKeptSettings(kept))
    {
        moveToGrid(keptPathOf(_path), kept.grid, _options);
        _kept = std::make_unique<KeptLevels>(keptPathOf(_path), _builder, _occupancy,
                                             _origin.settings, _options);
    }
    openWriter();
    const std::int64_t rows = KeptLevels::rowsAtATime(_builder.getGrid(), _origin.settings);
    for (const PixelRect& part : _layout.pending)
    {
        for (std::int64_t y = part.y; y < part.y + part.height;)
        {
            const std::int64_t end = std::min((y / rows + 1) * rows, part.y + part.height);
            refreshFine({part.x, y, part.width, end - y}, report);
            y = end;
        }
    }
    if (_kept)
    {
        refreshCoarse(report);
    }
    _writer->commit();
}

} // namespace osgPagedTexture
