// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TilePackContent.h>

#include <osgPagedTexture/ContentHash.h>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

/// Reads a store from its first byte to its last.
class Verifier
{
public:
    Verifier(const StoreFile& file, const PackHead& head, const TileGrid& grid,
             std::size_t maxProblems)
        : _file(file), _head(head), _grid(grid), _maxProblems(maxProblems)
    {
    }

    std::vector<std::string> run(const std::string& warning)
    {
        if (!warning.empty())
        {
            _problems.push_back(warning);
        }
        checkRecords();
        checkIndex();
        return std::move(_problems);
    }

private:
    bool isFull() const { return _problems.size() >= _maxProblems; }
    void add(const std::string& problem)
    {
        if (!isFull())
        {
            _problems.push_back("osgPagedTexture::TilePack: '" + _file.getPath() + "': " + problem);
        }
    }

    void checkRecords()
    {
        std::uint64_t place = PackDataStart;
        while (place < _head.packBytes && !isFull())
        {
            RecordHeader header;
            _file.read(&header, sizeof(header), place);
            const std::uint64_t room = _head.packBytes - place;
            if (!isKind(header.kind) || header.bytes > room || recordBytes(header.bytes) > room)
            {
                add("bytes " + std::to_string(place) + " to " + std::to_string(_head.packBytes) +
                    " cannot be told apart: a record's length is damaged");
                return;
            }
            const bool good = header.kind == RecordKind::Index ? checkPages(header, place)
                                                               : checkBytes(header, place);
            if (!good)
            {
                const bool tile = header.kind == RecordKind::Tile;
                add((tile ? nameOf(unpackKey(header.key)) + ", " : std::string()) +
                    "the record at byte " + std::to_string(place) + " is damaged");
            }
            place += recordBytes(header.bytes);
        }
    }

    static bool isKind(RecordKind kind)
    {
        return kind == RecordKind::Tile || kind == RecordKind::Index || kind == RecordKind::Text ||
               kind == RecordKind::Head;
    }

    bool checkBytes(const RecordHeader& header, std::uint64_t place)
    {
        _bytes.resize(recordBytes(header.bytes) - sizeof(header));
        _file.read(_bytes.data(), _bytes.size(), place + sizeof(header));
        return header.checksum == recordChecksum(header, _bytes.data()) &&
               std::all_of(_bytes.begin() + static_cast<std::ptrdiff_t>(header.bytes), _bytes.end(),
                           [](char fill) { return fill == 0; });
    }

    /// Also those of a segment that counts no more.
    bool checkPages(const RecordHeader& header, std::uint64_t place)
    {
        bool good = header.checksum == recordChecksum(header, nullptr) &&
                    header.bytes % sizeof(PackPage) == 0;
        PackPage page;
        for (std::uint64_t at = 0; good && at < header.bytes; at += sizeof(page))
        {
            _file.read(&page, sizeof(page), place + sizeof(header) + at);
            good = page.checksum == pageChecksum(page, place + sizeof(header) + at);
        }
        return good;
    }

    void checkIndex()
    {
        std::uint64_t encoded = 0, uniform = 0;
        try
        {
            const PackIndex index(_file, _head);
            PackIndex::Walk walk(index);
            for (auto entry = walk.next(); entry && !isFull(); entry = walk.next())
            {
                encoded += entry->isEncoded();
                uniform += entry->bytes == PackEntry::Uniform;
                checkEntry(*entry);
            }
        }
        catch (const TileStoreError& error)
        {
            add(std::string("the index cannot be walked to its end (") + error.what() + ")");
            return;
        }
        if (!isFull() && (encoded != _head.encodedTiles || uniform != _head.uniformTiles))
        {
            add("the index names " + std::to_string(encoded + uniform) + " tiles, its head " +
                std::to_string(_head.encodedTiles + _head.uniformTiles));
        }
    }

    void checkEntry(const PackEntry& entry)
    {
        if (!_grid.contains(unpackKey(entry.key)))
        {
            add(nameOf(unpackKey(entry.key)) + " lies outside the picture");
        }
        if (!entry.isEncoded())
        {
            return;
        }
        RecordHeader header;
        const bool inside = entry.place >= PackDataStart && entry.place < _head.packBytes &&
                            _head.packBytes - entry.place > recordBytes(entry.bytes);
        if (inside)
        {
            _file.read(&header, sizeof(header), entry.place);
        }
        if (!inside || header.kind != RecordKind::Tile || header.key != entry.key ||
            header.bytes != entry.bytes ||
            static_cast<std::uint32_t>(header.checksum) != entry.checksum)
        {
            add(nameOf(unpackKey(entry.key)) + " is not where the index says");
        }
    }

    const StoreFile& _file;
    const PackHead& _head;
    const TileGrid& _grid;
    const std::size_t _maxProblems;
    std::string _bytes;
    std::vector<std::string> _problems;
};

} // namespace

std::vector<std::string> TilePackReader::verify(std::size_t maxProblems) const
{
    const Content& content = *_content;
    return Verifier(content.file, content.found.head, content.settings.grid, maxProblems)
        .run(content.found.warning);
}

} // namespace osgPagedTexture
