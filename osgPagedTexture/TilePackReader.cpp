// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TilePack.h>

#include <osgPagedTexture/TilePackContent.h>

namespace osgPagedTexture
{

TilePackReader::Content::Content(const std::string& path)
    : file(path, StoreFile::Mode::Read), found(findHead(file)),
      settings(readSettings(file, found.head)), index(file, found.head)
{
}

TileData TilePackReader::Content::tileOf(const PackEntry& entry) const
{
    if (entry.bytes == PackEntry::None)
    {
        return {};
    }
    if (entry.bytes == PackEntry::Uniform)
    {
        TileColor color;
        for (std::size_t channel = 0; channel < color.size(); ++channel)
        {
            color[channel] = static_cast<std::uint8_t>(entry.place >> 8 * channel);
        }
        return TileData::uniform(color);
    }
    return TileData::encoded(readRecord(file, RecordKind::Tile, entry.place, entry.bytes, entry.key,
                                        nameOf(unpackKey(entry.key))));
}

std::string nameOf(const TileKey& key)
{
    return "tile " + std::to_string(key.x) + ", " + std::to_string(key.y) + " of level " +
           std::to_string(key.level);
}

TilePackReader::TilePackReader(const std::string& path)
    : _path(path), _content(std::make_unique<Content>(path))
{
}

TilePackReader::~TilePackReader() = default;

bool TilePackReader::refresh()
{
    auto content = std::make_unique<Content>(_path);
    const bool changed = _content->file.isReplaced() ||
                         content->found.head.generation != _content->found.head.generation;
    _content = std::move(content);
    return changed;
}

const TileStoreSettings& TilePackReader::getSettings() const
{
    return _content->settings;
}

TileData TilePackReader::read(const TileKey& key) const
{
    if (!_content->settings.grid.contains(key))
    {
        return {};
    }
    const auto entry = _content->index.find(packKey(key));
    return entry ? _content->tileOf(*entry) : TileData();
}

TilePackInfo TilePackReader::getInfo() const
{
    const PackHead& head = _content->found.head;
    TilePackInfo info;
    info.generation = head.generation;
    info.encodedTiles = head.encodedTiles;
    info.uniformTiles = head.uniformTiles;
    info.committedBytes = head.packBytes;
    info.liveBytes = PackDataStart + head.tileBytes + recordBytes(sizeof(PackHead));
    if (head.textPlace != 0)
    {
        info.liveBytes += recordBytes(head.textBytes);
    }
    const std::uint64_t entries = head.encodedTiles + head.uniformTiles;
    if (entries > 0)
    {
        const std::uint64_t pages = (entries + PackPage::Capacity - 1) / PackPage::Capacity;
        info.liveBytes += recordBytes(pages * sizeof(PackPage));
    }
    info.warning = _content->found.warning;
    return info;
}

void TilePackReader::forEachInRow(
    const TileRow& row, const std::function<void(std::int64_t, const TileData&)>& visit) const
{
    PackIndex::Walk walk(_content->index, packKey({row.level, 0, row.y}));
    const std::uint64_t end = packKey({row.level, 0, row.y + 1});
    for (auto entry = walk.next(); entry && entry->key < end; entry = walk.next())
    {
        if (entry->bytes != PackEntry::None)
        {
            visit(unpackKey(entry->key).x, _content->tileOf(*entry));
        }
    }
}

std::vector<TileLevelInfo> TilePackReader::countTiles() const
{
    const TileGrid& grid = _content->settings.grid;
    std::vector<TileLevelInfo> levels(grid.getLevels());
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        levels[level].places = grid.getTileCount(level);
    }
    PackIndex::Walk walk(_content->index);
    for (auto entry = walk.next(); entry; entry = walk.next())
    {
        TileLevelInfo& level = levels.at(unpackKey(entry->key).level);
        level.uniformTiles += entry->bytes == PackEntry::Uniform;
        level.encodedTiles += entry->isEncoded();
        level.encodedBytes += entry->isEncoded() ? entry->bytes : 0;
    }
    return levels;
}

} // namespace osgPagedTexture
