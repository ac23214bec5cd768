// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// What a packed store holds.
struct TilePackInfo
{
    std::uint64_t generation = 0; ///< Commits since the store was built or compacted; 1 or more.
    std::uint64_t encodedTiles = 0;
    std::uint64_t uniformTiles = 0;   ///< Take 24 bytes each.
    std::uint64_t committedBytes = 0; ///< Of the file; what follows belongs to no commit.
    std::uint64_t liveBytes = 0;      ///< That a compact store would have, about.
    /// Why an older commit than the last was opened, one line; else empty.
    std::string warning;

    double getDeadShare() const
    {
        return committedBytes > liveBytes ? double(committedBytes - liveBytes) / committedBytes : 0;
    }
};

/// What lies in a level of a store.
struct TileLevelInfo
{
    std::uint64_t places = 0; ///< Tiles that the level has room for; the rest of them is nothing.
    std::uint64_t encodedTiles = 0;
    std::uint64_t uniformTiles = 0;
    std::uint64_t encodedBytes = 0;
};

/// Reads a packed store: sees the commit that was the last one when it was opened, whatever a
/// writer does meanwhile, until refresh(). Memory is bounded whatever the number of tiles.
class OSGPAGEDTEXTURE_EXPORT TilePackReader : public TileReader
{
public:
    explicit TilePackReader(const std::string& path);
    ~TilePackReader() override;

    /// Goes to the last commit; true where it is another one. Not while other threads read.
    bool refresh();

    const TileStoreSettings& getSettings() const override;
    TileData read(const TileKey& key) const override;
    TilePackInfo getInfo() const;
    /// Walks the whole index. Throws TileStoreError.
    std::vector<TileLevelInfo> countTiles() const;

    /// The tiles x to lastX of a row that are not None, x ascending. Throws TileStoreError.
    void forEachInRow(const TileRow& row,
                      const std::function<void(std::int64_t x, const TileData&)>& visit) const;

    /// Reads the whole file and returns one line for each damage, at most `maxProblems`.
    std::vector<std::string> verify(std::size_t maxProblems = 100) const;

private:
    struct Content;
    std::string _path;
    std::unique_ptr<Content> _content;
};

/// Writes a packed store: one file that only grows. A commit appends the tiles and their index,
/// waits for the disk, and then writes one of two heads in turn at the file's beginning: killed at
/// any moment, the store is as before or as after. One process at a time, by a lock on
/// `<path>.lock`.
class OSGPAGEDTEXTURE_EXPORT TilePackWriter : public TileWriter
{
public:
    struct Options
    {
        bool durable = true;      ///< Waits for the disk at commits; else a power cut may harm.
        double waitSeconds = 0.0; ///< For another writer, before it throws Kind::Busy.
        /// Index entries that are held in memory, 24 bytes each. Stores are equal byte for byte
        /// only where this is.
        std::size_t maxPending = std::size_t(1) << 20;
    };

    /// Starts a new store, in `<path>.part` until its first commit, which replaces what was at
    /// `path`.
    TilePackWriter(const std::string& path, const TileStoreSettings& settings,
                   const Options& options);
    /// Opens a store to change it, at its last commit. Nothing may be read through it.
    TilePackWriter(const std::string& path, const Options& options);
    ~TilePackWriter() override;

    const TileStoreSettings& getSettings() const;
    /// From the next commit on.
    void setDescription(const std::string& description);
    void put(const TileKey& key, const TileData& tile) override;
    void commit() override;

private:
    struct Content;
    std::unique_ptr<Content> _content;
};

/// Puts all tiles of a packed store into another kind of store or a new packed one, in the order of
/// TileGrid::getRowsFinishedAt(). Commits nothing.
OSGPAGEDTEXTURE_EXPORT void copyTiles(const TilePackReader& from, TileWriter& to);

/// Writes a store's tiles again, in the order of TileGrid::getRowsFinishedAt() and without dead
/// bytes: the file is then byte for byte that of a new store whose tiles were put in that order.
/// Readers that have it open keep what they see.
OSGPAGEDTEXTURE_EXPORT void compactTilePack(const std::string& path,
                                            const TilePackWriter::Options& options = {});

} // namespace osgPagedTexture
