// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ImageFile.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace osgPagedTexture
{

/// A picture that was changed, and what its header says now.
struct ChangedFile
{
    std::string file;
    ImageInfo info;
    std::string error; ///< Why there is no `info`; empty where there is.
};

/// Looks at files of pictures again and again, and tells which have new content. Its thread, which
/// reads their headers too, starts with the first file. Any thread may call it.
class OSGPAGEDTEXTURE_EXPORT FileWatch
{
public:
    explicit FileWatch(double intervalSeconds = 1.0);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    /// What the file holds now is known; counts how often it is asked for.
    void add(const std::string& file);
    void remove(const std::string& file);

    /// Files that hold something else than before, each once a change, when writing has rested for
    /// one interval. A file that is gone is no change; one that is back with other content is.
    std::vector<ChangedFile> takeChanged();

private:
    struct Stamp
    {
        std::int64_t time = 0;
        std::uint64_t bytes = 0;
        bool operator==(const Stamp& other) const
        {
            return time == other.time && bytes == other.bytes;
        }
    };
    struct Watched
    {
        int users = 0;
        Stamp known; ///< With the content that users have.
        Stamp last;
        std::uint64_t content = 0; ///< 0: never looked at.
    };
    static bool stampOf(const std::string& file, Stamp& stamp);
    static std::uint64_t contentOf(const std::string& file);
    void run();
    void look(const std::string& file);

    const double _interval;
    std::mutex _mutex;
    std::condition_variable _wake;
    bool _ends = false;
    std::map<std::string, Watched> _files;
    std::vector<ChangedFile> _changed;
    std::thread _thread;
};

} // namespace osgPagedTexture
