// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/MipChain.h>

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Encoded mip chains in a folder, one DDS file each, that any number of threads and processes may
/// use at once.
///
/// An entry is named by the content of its source and by the settings that it was made with, so it
/// never grows old; where the folder is larger than the limit, what was read longest ago goes.
/// Every level has a checksum that is tested before its texels are given out; an entry that is not
/// whole is removed. A file appears under its name only when it is written to its end (temporary
/// file, then rename). It is not forced to the disk: what a power cut leaves half written fails its
/// checksum and is made again. A folder that cannot be written is read from all the same. Any
/// thread.
class OSGPAGEDTEXTURE_EXPORT ChainCache
{
public:
    struct Statistics
    {
        std::uint64_t hits = 0;
        std::uint64_t misses = 0;
        std::uint64_t damaged = 0; ///< Entries that failed their check and were removed.
        std::uint64_t written = 0;
        std::uint64_t evicted = 0;
        std::uint64_t bytesRead = 0;
        std::uint64_t bytesWritten = 0;
    };

    /// `folder` is made where it is missing; empty: nothing is kept.
    ChainCache(std::string folder, std::uint64_t limitBytes);

    /// The levels from `firstLevel` on; nothing where there is no such entry or none so fine. Reads
    /// those levels alone, which lie at the end of the file.
    std::optional<MipChain> read(const ContentHash& key, int firstLevel);

    /// What an entry holds, by its header alone: a chain without its levels.
    std::optional<MipChain> find(const ContentHash& key);

    /// Keeps a chain. An entry that holds finer levels is left as it is. Returns whether an entry
    /// at least as fine is there now; a failure is told once by takeMessages().
    bool write(const ContentHash& key, const MipChain& chain);

    /// Where the entry of a key lies or would lie.
    std::string getPath(const ContentHash& key) const;
    const std::string& getFolder() const { return _folder; }

    Statistics getStatistics() const;

    /// Lines for the user, each given once.
    std::vector<std::string> takeMessages();

private:
    void remove(const ContentHash& key);
    bool writeFile(const ContentHash& key, const MipChain& chain);
    void makeRoom(std::uint64_t newBytes);
    std::uint64_t removeOldest(std::uint64_t newBytes);
    void fail(const std::string& action, const std::string& cause);

    const std::string _folder;
    const std::uint64_t _limitBytes;
    mutable std::mutex _mutex; ///< Guards what follows; never held for the disk: frames take it.
    Statistics _statistics;
    std::vector<std::string> _messages;
    bool _failed = false;                                ///< A failure was told.
    std::chrono::steady_clock::time_point _writeAgain{}; ///< Not before, after a failure.

    std::mutex _roomMutex; ///< Guards what follows; whoever writes may wait for what is removed.
    bool _scanned = false;
    std::uint64_t _bytes = 0;          ///< In the folder, as far as this process knows.
    std::uint64_t _bytesSinceScan = 0; ///< Written by this process.
};

/// The key of a chain: what its source holds and how it is made.
OSGPAGEDTEXTURE_EXPORT ContentHash chainKey(const ContentHash& source, const std::string& settings);

} // namespace osgPagedTexture
