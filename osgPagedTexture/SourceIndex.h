// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ContentHash.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace osgPagedTexture
{

/// What the file system says about a file without opening it; times in ns since 1970.
struct FileStamp
{
    std::uint64_t bytes = 0;
    std::uint64_t inode = 0;
    std::int64_t modified = 0;
    std::int64_t changed = 0; ///< Also moves where `modified` was set back by hand.

    bool operator==(const FileStamp& other) const;
    bool operator!=(const FileStamp& other) const { return !(*this == other); }
};

/// Nothing where there is no such file.
OSGPAGEDTEXTURE_EXPORT std::optional<FileStamp> stampOf(const std::string& path);

/// Remembers the content hash of files from run to run, so that an unchanged file is not read to
/// learn what it holds.
///
/// The content decides. A stamp stands for it only where both of its times lay at least two
/// seconds in the past when the file was hashed: file systems keep times in steps as long as that,
/// and a file that changes twice within a step keeps its stamp. Until then it is hashed each time.
///
/// Records are appended to one file by any number of processes; each has a checksum, and one that
/// fails it is passed over. Trouble with the file costs no more than hashing again. Any thread.
class OSGPAGEDTEXTURE_EXPORT SourceIndex
{
public:
    /// `file` is read at the first use; empty: nothing outlives the process.
    explicit SourceIndex(std::string file);

    std::optional<ContentHash> find(const std::string& path, const FileStamp& stamp);

    /// `hashedAt`: ns since 1970, taken before the file was opened for hashing; `stamp` was taken
    /// before that too.
    void remember(const std::string& path, const FileStamp& stamp, const ContentHash& hash,
                  std::int64_t hashedAt);

private:
    struct Record
    {
        ContentHash path;
        FileStamp stamp;
        ContentHash content;
        std::uint64_t check = 0;
    };
    void load();
    void rewrite();
    static std::uint64_t checkOf(const Record& record);

    const std::string _file;
    std::mutex _mutex;
    bool _loaded = false;
    std::map<ContentHash, Record> _records;
};

/// Now, in ns since 1970.
OSGPAGEDTEXTURE_EXPORT std::int64_t wallClock();

} // namespace osgPagedTexture
