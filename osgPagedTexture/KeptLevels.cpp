// SPDX-License-Identifier: MIT
#include <osgPagedTexture/KeptLevels.h>

#include <osgPagedTexture/HalveRow.h>
#include <osgPagedTexture/TileExtract.h>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

TileGrid gridOf(const TileBuilder& builder)
{
    TileStoreSettings settings;
    builder.getKeptSettings(settings);
    return settings.grid;
}

void fill(std::vector<std::uint8_t>& pixels, std::size_t channels, const TileColor& color)
{
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
        pixels[i] = color[i % channels];
    }
}

} // namespace

KeptLevels::KeptLevels(const std::string& path, TileBuilder& builder,
                       const AtlasOccupancy& occupancy, const TileBuildSettings& settings,
                       const TilePackWriter::Options& options)
    : _path(path), _builder(builder), _occupancy(occupancy), _background(settings.background),
      _linearLight(settings.linearLight), _channels(std::size_t(settings.channels)),
      _maxTiles(std::max<std::size_t>(settings.maxBytes / 4 /
                                          (std::uint64_t(builder.getGrid().getPayload()) *
                                           builder.getGrid().getPayload() * settings.channels),
                                      16)),
      _grid(gridOf(builder)), _writer(std::make_unique<TilePackWriter>(path, options)),
      _reader(std::make_unique<TilePackReader>(path))
{
    if (_reader->getSettings().grid != _grid)
    {
        throw TileStoreError(TileStoreError::Kind::Damaged,
                             "osgPagedTexture::KeptLevels: '" + path +
                                 "' does not belong to the store; build the store anew");
    }
}

KeptLevels::~KeptLevels() = default;

std::int64_t KeptLevels::rowsAtATime(const TileGrid& store, const TileBuildSettings& settings)
{
    const std::int64_t unit = std::int64_t(store.getPayload()) << TileBuilder::KeptLevel;
    const std::uint64_t rowBytes =
        std::uint64_t(store.getWidth(TileBuilder::KeptLevel)) * std::uint64_t(settings.channels);
    const auto rows = std::int64_t(settings.maxBytes / 8 / rowBytes) << TileBuilder::KeptLevel;
    return std::max(rows / unit, std::int64_t(1)) * unit;
}

KeptLevels::Tile KeptLevels::load(const TileKey& key) const
{
    const std::size_t side = std::size_t(_grid.getPayload());
    Tile tile;
    tile.pixels.resize(side * side * _channels);
    const TileData data = _reader->read(key);
    if (data.kind != TileData::Kind::Encoded)
    {
        fill(tile.pixels, _channels,
             data.kind == TileData::Kind::Uniform ? data.color : _background);
        return tile;
    }
    const Pixels picture = decodeTile(data.bytes, _path);
    if (picture.width != int(side) || picture.height != int(side) ||
        picture.channels != int(_channels))
    {
        throw TileStoreError(TileStoreError::Kind::Damaged,
                             "osgPagedTexture::KeptLevels: '" + _path +
                                 "' has a tile of another shape; build the store anew");
    }
    for (std::size_t y = 0; y < side; ++y)
    {
        std::memcpy(tile.pixels.data() + y * side * _channels, picture.row(int(side - 1 - y)),
                    side * _channels);
    }
    return tile;
}

KeptLevels::Tile& KeptLevels::tileAt(int level, std::int64_t x, std::int64_t y)
{
    const auto found = _tiles.find({level, {y, x}});
    if (found != _tiles.end())
    {
        return found->second;
    }
    if (_tiles.size() >= _maxTiles)
    {
        makeRoom();
    }
    return _tiles.emplace(Key{level, {y, x}}, load({level, x, y})).first->second;
}

template <typename Visit>
void KeptLevels::forEachTile(int level, const PixelRect& area, const Visit& visit)
{
    const std::int64_t side = _grid.getPayload();
    for (std::int64_t y = area.y / side; y <= (area.y + area.height - 1) / side; ++y)
    {
        for (std::int64_t x = area.x / side; x <= (area.x + area.width - 1) / side; ++x)
        {
            const std::int64_t left = std::max(area.x, x * side);
            const std::int64_t right = std::min(area.x + area.width, (x + 1) * side);
            const std::int64_t bottom = std::min(area.y + area.height, (y + 1) * side);
            Tile& tile = tileAt(level, x, y);
            for (std::int64_t row = std::max(area.y, y * side); row < bottom; ++row)
            {
                std::uint8_t* const inTile =
                    tile.pixels.data() +
                    std::size_t((row - y * side) * side + left - x * side) * _channels;
                const std::int64_t inArea = (row - area.y) * area.width + left - area.x;
                visit(tile, inTile, std::size_t(inArea) * _channels,
                      std::size_t(right - left) * _channels);
            }
        }
    }
}

void KeptLevels::write(int level, const PixelRect& area, const std::uint8_t* pixels)
{
    forEachTile(level, area,
                [&](Tile& tile, std::uint8_t* inTile, std::size_t inArea, std::size_t bytes)
                {
                    tile.changed = true;
                    std::memcpy(inTile, pixels + inArea, bytes);
                });
}

void KeptLevels::read(int level, const PixelRect& area, std::vector<std::uint8_t>& pixels)
{
    const std::int64_t width = _grid.getWidth(level), height = _grid.getHeight(level);
    const std::int64_t x = std::clamp<std::int64_t>(area.x, 0, width - 1);
    const std::int64_t y = std::clamp<std::int64_t>(area.y, 0, height - 1);
    const PixelRect inside{x, y, std::min(area.x + area.width, width) - x,
                           std::min(area.y + area.height, height) - y};
    std::vector<std::uint8_t> there(std::size_t(inside.width * inside.height) * _channels);
    forEachTile(level, inside,
                [&](const Tile&, const std::uint8_t* inTile, std::size_t inArea, std::size_t bytes)
                { std::memcpy(there.data() + inArea, inTile, bytes); });
    if (inside.width == area.width && inside.height == area.height)
    {
        pixels.swap(there);
        return;
    }
    pixels.resize(std::size_t(area.width * area.height) * _channels);
    std::uint8_t* to = pixels.data();
    for (std::int64_t row = area.y; row < area.y + area.height; ++row)
    {
        const std::int64_t fromY = std::clamp(row, y, y + inside.height - 1) - y;
        for (std::int64_t column = area.x; column < area.x + area.width; ++column, to += _channels)
        {
            const std::int64_t fromX = std::clamp(column, x, x + inside.width - 1) - x;
            std::memcpy(to, there.data() + std::size_t(fromY * inside.width + fromX) * _channels,
                        _channels);
        }
    }
}

void KeptLevels::makeCoarser(int level, PixelRect changed)
{
    std::vector<std::uint8_t> fine, coarse;
    for (; level + 1 < _grid.getLevels(); ++level)
    {
        const std::int64_t x = changed.x / 2, y = changed.y / 2;
        changed = {x, y, (changed.x + changed.width - 1) / 2 + 1 - x,
                   (changed.y + changed.height - 1) / 2 + 1 - y};
        const PixelRect source{2 * x, 2 * y,
                               std::min(2 * changed.width, _grid.getWidth(level) - 2 * x),
                               std::min(2 * changed.height, _grid.getHeight(level) - 2 * y)};
        read(level, source, fine);
        coarse.resize(std::size_t(changed.width * changed.height) * _channels);
        const std::size_t fineRow = std::size_t(source.width) * _channels;
        const std::size_t coarseRow = std::size_t(changed.width) * _channels;
        for (std::int64_t row = 0; row < changed.height; ++row)
        {
            const std::int64_t lower = std::min(2 * row + 1, source.height - 1);
            halveRow(fine.data() + std::size_t(2 * row) * fineRow,
                     fine.data() + std::size_t(lower) * fineRow, std::size_t(source.width),
                     int(_channels), _linearLight, coarse.data() + std::size_t(row) * coarseRow);
        }
        write(level + 1, changed, coarse.data());
    }
}

TileData KeptLevels::makeTile(const TileKey& key)
{
    const PixelRect area = _builder.getGrid().getPixels(key);
    if (!_occupancy.holdsAny(area, key.level))
    {
        return {};
    }
    std::vector<std::uint8_t> pixels;
    read(key.level - TileBuilder::KeptLevel, area, pixels);
    return encode(pixels, int(area.width), int(area.height), false);
}

TileData KeptLevels::encode(const std::vector<std::uint8_t>& pixels, int width, int height,
                            bool kept) const
{
    std::vector<const std::uint8_t*> rows;
    for (int y = 0; y < height; ++y)
    {
        rows.push_back(pixels.data() + std::size_t(y) * std::size_t(width) * _channels);
    }
    return _builder.encode(rows.data(), width, height, kept);
}

void KeptLevels::put(const TileKey& key, Tile& tile)
{
    tile.changed = false;
    if (!_occupancy.holdsAny(_grid.getPixels(key), TileBuilder::KeptLevel + key.level))
    {
        _writer->put(key, {});
        return;
    }
    const int side = _grid.getPayload();
    std::vector<std::uint8_t> pixels;
    read(key.level, _grid.getPixels(key), pixels); // beyond the picture its edge
    _writer->put(key, encode(pixels, side, side, true));
}

void KeptLevels::putChanged()
{
    for (auto& [key, tile] : _tiles)
    {
        if (tile.changed)
        {
            put({key.first, key.second.second, key.second.first}, tile);
        }
    }
}

void KeptLevels::commit(const std::string& description)
{
    putChanged();
    _writer->setDescription(description);
    _writer->commit();
}

void KeptLevels::makeRoom()
{
    putChanged();
    _writer->commit();
    _reader->refresh();
    _tiles.clear();
}

} // namespace osgPagedTexture
