// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SourceIndex.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <sys/stat.h>

namespace osgPagedTexture
{

namespace
{

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

} // namespace

bool FileStamp::operator==(const FileStamp& other) const
{
    return bytes == other.bytes && inode == other.inode && modified == other.modified &&
           changed == other.changed;
}

std::optional<FileStamp> stampOf(const std::string& path)
{
    struct stat status;
    if (stat(path.c_str(), &status) != 0)
    {
        return {};
    }
    const auto nanoseconds = [](const timespec& time)
    { return std::int64_t(time.tv_sec) * 1000000000 + time.tv_nsec; };
    FileStamp stamp;
    stamp.bytes = static_cast<std::uint64_t>(status.st_size);
    stamp.inode = status.st_ino;
    stamp.modified = nanoseconds(status.st_mtim);
    stamp.changed = nanoseconds(status.st_ctim);
    return stamp;
}

std::int64_t wallClock()
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

SourceIndex::SourceIndex(std::string file) : _file(std::move(file)) {}

std::uint64_t SourceIndex::checkOf(const Record& record)
{
    return checksum(&record, offsetof(Record, check));
}

void SourceIndex::load()
{
    _loaded = true;
    const File file(_file.empty() ? nullptr : std::fopen(_file.c_str(), "rb"));
    if (!file)
    {
        return;
    }
    std::string text;
    char buffer[1 << 16];
    while (const std::size_t count = std::fread(buffer, 1, sizeof(buffer), file.get()))
    {
        text.append(buffer, count);
    }
    std::size_t records = 0;
    for (std::size_t at = 0; at + sizeof(Record) <= text.size();)
    {
        Record record;
        std::memcpy(&record, text.data() + at, sizeof(Record));
        // A record that was cut off shifts those behind it.
        const bool whole = checkOf(record) == record.check;
        at += whole ? sizeof(Record) : 1;
        if (whole)
        {
            _records[record.path] = record;
            ++records;
        }
    }
    if (text.size() / sizeof(Record) > 2 * _records.size() + 1000 ||
        text.size() != records * sizeof(Record))
    {
        rewrite();
    }
}

/// Drops what is outdated or damaged. What another process appends meanwhile is lost, and hashed
/// again.
void SourceIndex::rewrite()
{
    const std::string temporary = _file + "." + hashText(std::to_string(wallClock())).text();
    File file(std::fopen(temporary.c_str(), "wbx"));
    if (!file)
    {
        return;
    }
    bool written = true;
    for (const auto& [path, record] : _records)
    {
        written = written && std::fwrite(&record, sizeof(record), 1, file.get()) == 1;
    }
    written = std::fclose(file.release()) == 0 && written;
    std::error_code ignored;
    if (written)
    {
        std::filesystem::rename(temporary, _file, ignored);
    }
    std::filesystem::remove(temporary, ignored);
}

std::optional<ContentHash> SourceIndex::find(const std::string& path, const FileStamp& stamp)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_loaded)
    {
        load();
    }
    const auto found = _records.find(hashText(path));
    if (found == _records.end() || found->second.stamp != stamp)
    {
        return {};
    }
    return found->second.content;
}

void SourceIndex::remember(const std::string& path, const FileStamp& stamp, const ContentHash& hash,
                           std::int64_t hashedAt)
{
    constexpr std::int64_t settled = 2000000000;
    if (std::max(stamp.modified, stamp.changed) + settled > hashedAt)
    {
        return;
    }
    Record record{hashText(path), stamp, hash};
    record.check = checkOf(record);
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_loaded)
    {
        load();
    }
    _records[record.path] = record;
    if (_file.empty())
    {
        return;
    }
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(_file).parent_path(), ignored);
    // Appended by one write, so that records of several processes do not mix.
    if (const File file{std::fopen(_file.c_str(), "ab")})
    {
        std::setvbuf(file.get(), nullptr, _IONBF, 0);
        std::fwrite(&record, sizeof(record), 1, file.get());
    }
}

} // namespace osgPagedTexture
