// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PackAppender.h>
#include <osgPagedTexture/TilePack.h>
#include <osgPagedTexture/TilePackContent.h>

#include <algorithm>
#include <filesystem>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t MaxTileBytes = std::size_t(1) << 30;
constexpr char PartExtension[] = ".part";

PackHead openHead(StoreFile& file, bool durable)
{
    FoundHead found = findHead(file);
    if (!found.warning.empty())
    {
        // Before more is written the last commit gets its own head back.
        writeHead(file, found.head);
        if (durable)
        {
            file.sync();
        }
    }
    if (file.getBytes() > found.head.packBytes)
    {
        file.truncate(found.head.packBytes); // left by a writer that died
    }
    return found.head;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused,
                         "osgPagedTexture::TilePack: '" + path + "': " + what);
}

} // namespace

struct TilePackWriter::Content
{
    /// Without settings it opens the store that is there.
    Content(const std::string& newPath, const Options& newOptions,
            const TileStoreSettings* newSettings)
        : path(newPath), options(newOptions), lock(path, options.waitSeconds),
          isNew(newSettings != nullptr),
          file(isNew ? path + PartExtension : path,
               isNew ? StoreFile::Mode::Create : StoreFile::Mode::Change),
          head(isNew ? makeHead(*newSettings) : openHead(file, options.durable)),
          settings(isNew ? *newSettings : readSettings(file, head)),
          textChanged(isNew && !settings.description.empty()), appender(file, head.packBytes)
    {
    }
    ~Content();

    void guarded(const std::function<void()>& change);
    void put(const TileKey& key, const TileData& tile);
    void commit();
    void flushPending();
    void count(const PackEntry& entry, bool added);
    void mergeSegments();
    void finishHead();

    const std::string path;
    const Options options;
    const StoreLock lock;
    bool isNew; ///< Nothing is committed yet.
    StoreFile file;
    PackHead head; ///< Becomes that of the next commit.
    TileStoreSettings settings;
    bool textChanged;
    PackAppender appender;
    std::vector<PackEntry> pending; ///< In the order they were put.
    std::uint64_t committedBytes = head.packBytes;
    bool changed = false;     ///< Since the last commit.
    bool headWritten = false; ///< Of the commit that is under way.
    bool failed = false;      ///< Then only the last commit is whole, and no other can follow.
};

TilePackWriter::Content::~Content()
{
    if (!changed && !isNew)
    {
        return;
    }
    std::error_code error; // what is left over does no harm, the next writer removes it
    if (isNew)
    {
        std::filesystem::remove(path + PartExtension, error);
    }
    else if (!headWritten)
    {
        std::filesystem::resize_file(path, committedBytes, error);
    }
}

/// Runs a step that may fail half-way.
void TilePackWriter::Content::guarded(const std::function<void()>& change)
{
    if (failed)
    {
        throw TileStoreError(TileStoreError::Kind::Unwritable,
                             "osgPagedTexture::TilePack: '" + path +
                                 "' cannot be written after an earlier failure; open it again");
    }
    failed = true;
    if (!changed)
    {
        headWritten = false;
        changed = true;
    }
    change();
    failed = false;
}

void TilePackWriter::Content::put(const TileKey& key, const TileData& tile)
{
    PackEntry entry;
    entry.key = packKey(key);
    if (tile.kind == TileData::Kind::Uniform)
    {
        entry.bytes = PackEntry::Uniform;
        for (std::size_t channel = 0; channel < tile.color.size(); ++channel)
        {
            entry.place |= std::uint64_t(tile.color[channel]) << 8 * channel;
        }
    }
    else if (tile.kind == TileData::Kind::Encoded)
    {
        const PackAppender::Record record =
            appender.append(RecordKind::Tile, entry.key, tile.bytes.data(), tile.bytes.size());
        entry.place = record.place;
        entry.bytes = static_cast<std::uint32_t>(tile.bytes.size());
        entry.checksum = static_cast<std::uint32_t>(record.checksum);
    }
    pending.push_back(entry);
    if (pending.size() >= options.maxPending)
    {
        flushPending();
    }
}

/// Makes a segment of what was put.
void TilePackWriter::Content::flushPending()
{
    std::stable_sort(pending.begin(), pending.end(),
                     [](const PackEntry& a, const PackEntry& b) { return a.key < b.key; });
    const PackIndex index(file, head);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pending.size(); ++i)
    {
        if (i + 1 < pending.size() && pending[i + 1].key == pending[i].key)
        {
            continue; // put again later
        }
        const auto old = index.find(pending[i].key);
        if (old)
        {
            count(*old, false);
        }
        count(pending[i], true);
        if (old || pending[i].bytes != PackEntry::None)
        {
            pending[kept++] = pending[i];
        }
    }
    if (kept > 0)
    {
        auto entry = pending.begin();
        const auto end = entry + kept;
        head.segments[head.segmentCount++] = appender.appendSegment(
            [&]() { return entry == end ? std::nullopt : std::optional(*entry++); });
    }
    pending.clear();
    mergeSegments();
}

void TilePackWriter::Content::count(const PackEntry& entry, bool added)
{
    const std::uint64_t one = added ? 1 : -1; // unsigned numbers wrap as they should
    head.uniformTiles += entry.bytes == PackEntry::Uniform ? one : 0;
    head.encodedTiles += entry.isEncoded() ? one : 0;
    head.tileBytes += entry.isEncoded() ? one * recordBytes(entry.bytes) : 0;
}

/// Makes one of the last segments where they are not much shorter than those before: searches meet
/// few segments, and an entry is written again only as often as the logarithm of their number.
void TilePackWriter::Content::mergeSegments()
{
    std::uint32_t first = head.segmentCount;
    std::uint64_t entries = 0;
    while (first > 0 &&
           (first == head.segmentCount || 2 * entries >= head.segments[first - 1].entries))
    {
        entries += head.segments[--first].entries;
    }
    if (first + 1 >= head.segmentCount)
    {
        return;
    }
    const PackIndex index(file, head);
    PackIndex::Walk walk(index, 0, first);
    const PackSegment merged = appender.appendSegment(
        [&]()
        {
            auto entry = walk.next();
            while (entry && entry->bytes == PackEntry::None && first == 0)
            {
                entry = walk.next(); // nothing below that it would hide
            }
            return entry;
        });
    std::fill(head.segments + first, head.segments + head.segmentCount, PackSegment());
    head.segments[first] = merged;
    head.segmentCount = first + (merged.entries > 0 ? 1 : 0);
    if (merged.entries == 0)
    {
        head.segments[first] = PackSegment();
    }
}

void TilePackWriter::Content::finishHead()
{
    if (textChanged)
    {
        head.textBytes = settings.description.size();
        head.textPlace = appender
                             .append(RecordKind::Text, 0, settings.description.data(),
                                     settings.description.size())
                             .place;
    }
    ++head.generation;
    head.packBytes = appender.getPlace() + recordBytes(sizeof(head));
    setChecksum(head);
    appender.append(RecordKind::Head, 0, &head, sizeof(head));
    appender.flush();
}

void TilePackWriter::Content::commit()
{
    flushPending();
    finishHead();
    if (options.durable)
    {
        file.sync(); // the head must not reach the disk before what it names
    }
    headWritten = true;
    writeHead(file, head);
    if (options.durable)
    {
        file.sync();
    }
    if (isNew)
    {
        file.moveTo(path, options.durable);
    }
    isNew = false;
    changed = false;
    textChanged = false;
    committedBytes = head.packBytes;
}

TilePackWriter::TilePackWriter(const std::string& path, const TileStoreSettings& settings,
                               const Options& options)
{
    makeHead(settings); // refuses bad ones before there is a file
    _content = std::make_unique<Content>(path, options, &settings);
}

TilePackWriter::TilePackWriter(const std::string& path, const Options& options)
    : _content(std::make_unique<Content>(path, options, nullptr))
{
}

TilePackWriter::~TilePackWriter() = default;

const TileStoreSettings& TilePackWriter::getSettings() const
{
    return _content->settings;
}

void TilePackWriter::setDescription(const std::string& description)
{
    _content->textChanged |= description != _content->settings.description;
    _content->changed |= _content->textChanged;
    _content->settings.description = description;
}

void TilePackWriter::put(const TileKey& key, const TileData& tile)
{
    if (!_content->settings.grid.contains(key))
    {
        refuse(_content->path, nameOf(key) + " lies outside; name a tile of the grid");
    }
    if (tile.kind == TileData::Kind::Encoded &&
        (tile.bytes.empty() || tile.bytes.size() > MaxTileBytes))
    {
        refuse(_content->path, nameOf(key) + " has " + std::to_string(tile.bytes.size()) +
                                   " bytes; a tile has 1 byte to 1 GiB");
    }
    _content->guarded([&]() { _content->put(key, tile); });
}

void TilePackWriter::commit()
{
    if (_content->changed || _content->isNew)
    {
        _content->guarded([&]() { _content->commit(); });
    }
}

} // namespace osgPagedTexture
