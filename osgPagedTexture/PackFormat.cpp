// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PackFormat.h>

#include <osgPagedTexture/ContentHash.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <optional>
#include <thread>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t ChecksummedBytes = offsetof(PackHead, checksum);

bool isValid(const PackHead& head, std::uint64_t fileBytes)
{
    return head.magic == PackHead().magic && head.segmentCount <= PackHead::MaxSegments &&
           head.packBytes <= fileBytes && head.packBytes >= PackDataStart && head.generation > 0 &&
           head.checksum == checksum(&head, ChecksummedBytes);
}

bool isUnused(const PackHead& head)
{
    const char* bytes = reinterpret_cast<const char*>(&head);
    return std::all_of(bytes, bytes + sizeof(head), [](char byte) { return byte == 0; });
}

/// The last copy of a head that ends a commit between two places.
std::optional<PackHead> findCopy(const StoreFile& file, std::uint64_t begin, std::uint64_t end)
{
    constexpr std::uint64_t copyBytes = recordBytes(sizeof(PackHead));
    constexpr std::uint64_t stepBytes = 1 << 20;
    std::string bytes;
    for (std::uint64_t stepEnd = end / 8 * 8; stepEnd > begin;)
    {
        const std::uint64_t stepBegin = stepEnd - std::min(stepBytes, stepEnd - begin);
        bytes.resize(stepEnd - stepBegin + copyBytes);
        bytes.resize(file.readSome(bytes.data(), bytes.size(), stepBegin));
        for (std::uint64_t at = (stepEnd - stepBegin) / 8 * 8; at > 0;)
        {
            at -= 8;
            RecordHeader header;
            PackHead head;
            if (at + copyBytes > bytes.size())
            {
                continue;
            }
            std::memcpy(&header, &bytes[at], sizeof(header));
            if (header.kind == RecordKind::Head && header.bytes == sizeof(head))
            {
                std::memcpy(&head, &bytes[at + sizeof(header)], sizeof(head));
                if (isValid(head, end) && head.packBytes == stepBegin + at + copyBytes)
                {
                    return head;
                }
            }
        }
        stepEnd = stepBegin;
    }
    return std::nullopt;
}

} // namespace

void throwDamaged(const std::string& path, const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Damaged,
                         "osgPagedTexture::TilePack: '" + path + "': " + what +
                             "; copy the store again or build it anew");
}

std::uint64_t recordChecksum(const RecordHeader& header, const void* bytes)
{
    const std::uint64_t seed = checksum(&header, offsetof(RecordHeader, checksum));
    return header.kind == RecordKind::Index ? seed : checksum(bytes, header.bytes, seed);
}

FoundHead findHead(const StoreFile& file)
{
    PackHead heads[2];
    FoundHead found;
    bool valid = false, damaged = true;
    std::uint64_t fileBytes = 0;
    // A writer may be about to replace a head that is read: look again before it counts as damaged.
    for (int attempt = 0; attempt < 3 && damaged; ++attempt)
    {
        std::this_thread::sleep_for(std::chrono::microseconds(200 * attempt));
        fileBytes = file.getBytes();
        std::memset(static_cast<void*>(heads), 0, sizeof(heads));
        file.readSome(heads, sizeof(heads), 0);
        valid = damaged = false;
        for (const PackHead& head : heads)
        {
            const bool good = isValid(head, fileBytes);
            damaged = damaged || (!good && !isUnused(head));
            if (good && (!valid || head.generation > found.head.generation))
            {
                found.head = head;
                valid = true;
            }
        }
    }
    if (damaged || !valid)
    {
        const auto copy = findCopy(file, valid ? found.head.packBytes : PackDataStart, fileBytes);
        if (!copy && !valid)
        {
            throwDamaged(file.getPath(), "is no packed tile store, or all its heads are lost");
        }
        found.head = copy ? *copy : found.head;
        found.warning = "osgPagedTexture::TilePack: '" + file.getPath() +
                        "': a head is damaged; generation " +
                        std::to_string(found.head.generation) +
                        " is the last whole one; copy the store again or compact it";
    }
    return found;
}

PackHead makeHead(const TileStoreSettings& settings)
{
    PackHead head;
    const TileGrid& grid = settings.grid;
    if (settings.format.empty() || settings.format.size() >= head.format.size() ||
        settings.format.find_first_of("/\\.") != std::string::npos)
    {
        throw TileStoreError(TileStoreError::Kind::Refused,
                             "osgPagedTexture::TilePack: '" + settings.format +
                                 "' is no tile format; name one like jpg, at most 7 letters");
    }
    head.width = grid.getWidth();
    head.height = grid.getHeight();
    head.tileSide = grid.getTileSide();
    head.border = grid.getBorder();
    head.edge = static_cast<std::uint32_t>(grid.getEdge());
    std::copy(settings.format.begin(), settings.format.end(), head.format.begin());
    return head;
}

TileStoreSettings readSettings(const StoreFile& file, const PackHead& head)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(head.width, head.height, head.tileSide, head.border,
                             head.edge ? TileGrid::Edge::Clipped : TileGrid::Edge::Padded);
    settings.format =
        std::string(head.format.begin(), std::find(head.format.begin(), head.format.end(), '\0'));
    if (head.textPlace != 0)
    {
        settings.description = readRecord(file, RecordKind::Text, head.textPlace, head.textBytes, 0,
                                          "the description");
    }
    return settings;
}

void setChecksum(PackHead& head)
{
    head.checksum = checksum(&head, ChecksummedBytes);
}

void writeHead(StoreFile& file, PackHead& head)
{
    setChecksum(head);
    file.write(&head, sizeof(head), head.generation % 2 * PackHeadBytes);
}

std::string readRecord(const StoreFile& file, RecordKind kind, std::uint64_t place,
                       std::uint64_t bytes, std::uint64_t key, const std::string& what)
{
    std::string text(sizeof(RecordHeader) + bytes, '\0');
    file.read(text.data(), text.size(), place);
    RecordHeader header;
    std::memcpy(&header, text.data(), sizeof(header));
    if (header.kind != kind || header.bytes != bytes || header.key != key ||
        header.checksum != recordChecksum(header, text.data() + sizeof(header)))
    {
        throwDamaged(file.getPath(), what + " is damaged");
    }
    text.erase(0, sizeof(header));
    return text;
}

} // namespace osgPagedTexture
