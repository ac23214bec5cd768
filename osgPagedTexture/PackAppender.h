// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PackFormat.h>
#include <osgPagedTexture/PackIndex.h>

#include <functional>
#include <optional>
#include <string>

namespace osgPagedTexture
{

/// Appends records to a packed store, some MiB at a time.
class PackAppender
{
public:
    PackAppender(StoreFile& file, std::uint64_t place) : _file(file), _written(place) {}

    std::uint64_t getPlace() const { return _written + _buffer.size(); }

    struct Record
    {
        std::uint64_t place;
        std::uint64_t checksum;
    };
    Record append(RecordKind kind, std::uint64_t key, const void* bytes, std::uint64_t count);

    /// Appends a segment of all entries that `next` gives, sorted by key, until it gives none.
    using NextEntry = std::function<std::optional<PackEntry>()>;
    PackSegment appendSegment(const NextEntry& next);

    /// Hands all to the operating system.
    void flush();

private:
    void add(const void* bytes, std::uint64_t count);
    void addPage(PackPage& page);

    StoreFile& _file;
    std::uint64_t _written;
    std::string _buffer;
};

} // namespace osgPagedTexture
