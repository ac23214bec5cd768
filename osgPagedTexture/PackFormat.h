// SPDX-License-Identifier: MIT
// What lies where in a packed store: two heads of 4 KiB, then records that are only ever appended.
#pragma once

#include <osgPagedTexture/StoreFile.h>
#include <osgPagedTexture/TileStore.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace osgPagedTexture
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "a store's numbers are little-endian");

constexpr std::uint64_t PackHeadBytes = 4096;
constexpr std::uint64_t PackDataStart = 2 * PackHeadBytes;

enum class RecordKind : std::uint32_t
{
    Tile = 0x454c4954,  ///< "TILE": the bytes of a picture.
    Index = 0x58444e49, ///< "INDX": pages of entries, each with its own checksum.
    Text = 0x54584554,  ///< "TEXT": the store's description.
    Head = 0x44414548   ///< "HEAD": a copy of the head, ends a commit.
};

/// Before the bytes of each record, which are filled up with zeros to a multiple of 8.
struct RecordHeader
{
    RecordKind kind = RecordKind::Tile;
    std::uint32_t reserved = 0;
    std::uint64_t bytes = 0;
    std::uint64_t key = 0;      ///< Of a tile; else 0.
    std::uint64_t checksum = 0; ///< Of what is above and, but for an index, the bytes.
};
static_assert(sizeof(RecordHeader) == 32);

std::uint64_t recordChecksum(const RecordHeader& header, const void* bytes);

/// Of header, bytes and fill.
constexpr std::uint64_t recordBytes(std::uint64_t bytes)
{
    return sizeof(RecordHeader) + (bytes + 7) / 8 * 8;
}

/// Sorts by level, row and column.
constexpr std::uint64_t packKey(const TileKey& key)
{
    return std::uint64_t(key.level) << 58 | std::uint64_t(key.y) << 29 | std::uint64_t(key.x);
}

constexpr TileKey unpackKey(std::uint64_t key)
{
    constexpr std::uint64_t mask = (std::uint64_t(1) << 29) - 1;
    return {int(key >> 58), std::int64_t(key & mask), std::int64_t(key >> 29 & mask)};
}

/// What the index knows of a tile.
struct PackEntry
{
    static constexpr std::uint32_t None = 0; ///< A tile that was taken away.
    static constexpr std::uint32_t Uniform = 0xffffffff;

    std::uint64_t key = 0;
    std::uint64_t place = 0;    ///< Of the record in the file; or the colour, red lowest.
    std::uint32_t bytes = 0;    ///< Of the picture, or one of the above.
    std::uint32_t checksum = 0; ///< The low half of the record's.

    bool isEncoded() const { return bytes != None && bytes != Uniform; }
};
static_assert(sizeof(PackEntry) == 24);

/// 4 KiB of an index.
struct PackPage
{
    static constexpr std::uint32_t Capacity = 170;
    std::uint64_t checksum = 0; ///< Of what follows and the page's place.
    std::uint32_t count = 0;
    std::uint32_t reserved = 0;
    PackEntry entries[Capacity];
};
static_assert(sizeof(PackPage) == 4096);

/// Entries sorted by key; those of a later segment count.
struct PackSegment
{
    std::uint64_t place = 0; ///< Of the first page.
    std::uint64_t pages = 0;
    std::uint64_t entries = 0;
};

/// All that a commit says.
struct PackHead
{
    /// Each segment is more than twice as long as the next, so that there are never more.
    static constexpr std::uint32_t MaxSegments = 40;

    std::array<char, 8> magic{'o', 's', 'g', 'T', 'i', 'l', 'e', '1'};
    std::uint64_t generation = 0;
    std::uint64_t packBytes = PackDataStart; ///< Up to which the file belongs to the commit.
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int32_t tileSide = 0;
    std::int32_t border = 0;
    std::uint32_t edge = 0;
    std::uint32_t segmentCount = 0;
    std::array<char, 8> format{};
    std::uint64_t textPlace = 0; ///< Of the description's record; 0 for none.
    std::uint64_t textBytes = 0;
    std::uint64_t encodedTiles = 0;
    std::uint64_t uniformTiles = 0;
    std::uint64_t tileBytes = 0; ///< Of the records of tiles that count.
    PackSegment segments[MaxSegments];
    char reserved[PackHeadBytes - 1072] = {};
    std::uint64_t checksum = 0;
};
static_assert(sizeof(PackHead) == PackHeadBytes);

/// A head that was found in a file.
struct FoundHead
{
    PackHead head;
    std::string warning; ///< Why it may not be the last commit, or what else is wrong; else empty.
};

/// The last commit of a file. Where a head is damaged, the copies that end the commits are looked
/// for from the file's end. Throws TileStoreError.
FoundHead findHead(const StoreFile& file);

PackHead makeHead(const TileStoreSettings& settings);
/// Throws TileStoreError where the numbers make no sense.
TileStoreSettings readSettings(const StoreFile& file, const PackHead& head);
/// Writes it where the heads of odd or even generations lie.
void writeHead(StoreFile& file, PackHead& head);
void setChecksum(PackHead& head);

/// A record's bytes, checked. Throws TileStoreError; `what` names it in the message.
std::string readRecord(const StoreFile& file, RecordKind kind, std::uint64_t place,
                       std::uint64_t bytes, std::uint64_t key, const std::string& what);

[[noreturn]] void throwDamaged(const std::string& path, const std::string& what);

} // namespace osgPagedTexture
