// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace osgPagedTexture
{

/// A file that is read and written at places. Every failure throws a TileStoreError that names it.
class OSGPAGEDTEXTURE_EXPORT StoreFile
{
public:
    enum class Mode
    {
        Read,
        Change, ///< Reads and writes one that exists.
        Create  ///< Reads and writes an empty one.
    };
    StoreFile(const std::string& path, Mode mode);
    ~StoreFile();
    StoreFile(StoreFile&& other) noexcept
        : _path(std::move(other._path)), _descriptor(std::exchange(other._descriptor, -1))
    {
    }
    StoreFile& operator=(StoreFile&&) = delete;

    const std::string& getPath() const { return _path; }
    std::uint64_t getBytes() const;
    /// Whether `_path` names another file by now, or none.
    bool isReplaced() const;

    /// Reads up to `count` bytes; fewer where the file ends.
    std::size_t readSome(void* bytes, std::size_t count, std::uint64_t place) const;
    /// Throws where the file ends before.
    void read(void* bytes, std::size_t count, std::uint64_t place) const;
    void write(const void* bytes, std::size_t count, std::uint64_t place);
    void truncate(std::uint64_t bytes);
    /// Returns when the disk has what was written.
    void sync();
    /// Takes the place of `path`; with `durable` the disk knows it on return.
    void moveTo(const std::string& path, bool durable);

private:
    std::string _path;
    int _descriptor;
};

/// Throws TileStoreError where a file cannot grow any more. Many writers of other libraries do not
/// see that a disk is full; a file that they could not write to its end does not grow either.
OSGPAGEDTEXTURE_EXPORT void checkRoom(const std::string& path);

/// The right to write a store, held until the end of the object or of the process.
class StoreLock
{
public:
    /// Throws TileStoreError::Kind::Busy where another one holds it for longer than this.
    StoreLock(const std::string& storePath, double waitSeconds);
    ~StoreLock();
    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

private:
    int _descriptor = -1;
};

} // namespace osgPagedTexture
