// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ChainCache.h>

#include <osgPagedTexture/DdsFile.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <utility>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

namespace
{

constexpr char Extension[] = ".dds";
constexpr char TemporaryExtension[] = ".part";

/// Times of use need not be exact; a file is touched at most this often.
constexpr auto TouchInterval = std::chrono::minutes(1);
/// A temporary file that is older belongs to a process that died.
constexpr auto TemporaryAge = std::chrono::hours(1);
/// After a failure to write, the disk is left alone for so long.
constexpr auto FailurePause = std::chrono::seconds(30);

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// A name that no other thread or process takes.
std::string temporaryName(const std::string& path)
{
    static const std::uint64_t process =
        std::uint64_t(std::random_device{}()) << 32 | std::random_device{}();
    static std::atomic<std::uint64_t> count{0};
    const std::uint64_t number[] = {
        process, ++count,
        static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count())};
    // A forked process shares the first two; should it take the same time, "x" makes it fail.
    return path + "." + hashBytes(number, sizeof(number)).text().substr(0, 16) + TemporaryExtension;
}

std::uint64_t lengthOf(std::FILE* file)
{
    std::fseek(file, 0, SEEK_END);
    const long length = std::ftell(file);
    std::rewind(file);
    return length < 0 ? 0 : static_cast<std::uint64_t>(length);
}

/// An entry's file with what its header says; a file without that is damaged.
struct OpenEntry
{
    OpenEntry(const std::string& path, const ContentHash& key)
        : file(std::fopen(path.c_str(), "rb"))
    {
        if (file)
        {
            const std::uint64_t fileBytes = lengthOf(file.get());
            std::string head(MaxChainHeaderBytes, '\0');
            head.resize(std::fread(head.data(), 1, head.size(), file.get()));
            layout = parseChainHeader(head, fileBytes);
            damaged = !layout || layout->key != key;
        }
    }
    File file;
    std::optional<ChainFileLayout> layout;
    bool damaged = false;
};

/// Notes that an entry was used.
void touch(const std::string& path)
{
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    const auto used = fs::last_write_time(path, error);
    if (!error && (used + TouchInterval < now || used > now))
    {
        fs::last_write_time(path, now, error);
    }
}

struct Entry
{
    fs::path path;
    std::uint64_t bytes;
    fs::file_time_type used;
};

/// All entries; left-over temporary files are removed on the way. Times in the future, left by a
/// clock that has gone back since, become now, or such entries would never go.
std::vector<Entry> scan(const std::string& folder)
{
    std::vector<Entry> entries;
    const auto now = fs::file_time_type::clock::now();
    std::error_code error;
    const auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator at(folder, options, error), end; !error && at != end;
         at.increment(error))
    {
        std::error_code ignored; // another process may have removed it
        const auto used = at->last_write_time(ignored);
        if (at->path().extension() == TemporaryExtension)
        {
            if (used + TemporaryAge < now || used > now + TemporaryAge)
            {
                fs::remove(at->path(), ignored);
            }
        }
        else if (at->path().extension() == Extension)
        {
            if (used > now)
            {
                fs::last_write_time(at->path(), now, ignored);
            }
            const auto bytes = at->file_size(ignored);
            entries.push_back({at->path(), ignored ? 0 : bytes, std::min(used, now)});
        }
    }
    return entries;
}

} // namespace

ContentHash chainKey(const ContentHash& source, const std::string& settings)
{
    return hashText(source.text() + "\n" + settings);
}

ChainCache::ChainCache(std::string folder, std::uint64_t limitBytes)
    : _folder(std::move(folder)), _limitBytes(limitBytes)
{
}

std::string ChainCache::getPath(const ContentHash& key) const
{
    const std::string name = key.text();
    return (fs::path(_folder) / name.substr(0, 2) / (name + Extension)).string();
}

std::optional<MipChain> ChainCache::find(const ContentHash& key)
{
    if (_folder.empty())
    {
        return {};
    }
    const OpenEntry entry(getPath(key), key);
    if (entry.damaged)
    {
        remove(key);
    }
    if (!entry.file || entry.damaged)
    {
        return {};
    }
    const ChainFileLayout& layout = *entry.layout;
    return MipChain{layout.format, layout.width, layout.height, layout.firstLevel, {}};
}

void ChainCache::remove(const ContentHash& key)
{
    std::error_code ignored;
    fs::remove(getPath(key), ignored);
    const std::lock_guard<std::mutex> lock(_mutex);
    ++_statistics.damaged;
}

std::optional<MipChain> ChainCache::read(const ContentHash& key, int firstLevel)
{
    std::optional<MipChain> chain;
    std::uint64_t bytesRead = 0;
    if (!_folder.empty())
    {
        OpenEntry entry(getPath(key), key);
        if (entry.file && !entry.damaged && entry.layout->firstLevel <= firstLevel)
        {
            const ChainFileLayout& layout = *entry.layout;
            const int level = std::min(firstLevel, layout.firstLevel + layout.levels() - 1);
            const std::uint64_t start = layout.levelOffset(level);
            std::fseek(entry.file.get(), static_cast<long>(start), SEEK_SET);
            chain = readChainTail(layout, level,
                                  [&](void* bytes, std::size_t count)
                                  {
                                      const auto got =
                                          std::fread(bytes, 1, count, entry.file.get());
                                      bytesRead += got;
                                      return got == count;
                                  });
            entry.damaged = !chain;
        }
        entry.file.reset();
        if (entry.damaged)
        {
            remove(key);
        }
        else if (chain)
        {
            touch(getPath(key));
        }
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    ++(chain ? _statistics.hits : _statistics.misses);
    _statistics.bytesRead += bytesRead;
    return chain;
}

bool ChainCache::write(const ContentHash& key, const MipChain& chain)
{
    const auto now = std::chrono::steady_clock::now();
    if (_folder.empty() || chain.levels.empty())
    {
        return false;
    }
    if (const auto held = find(key); held && held->firstLevel <= chain.firstLevel)
    {
        return true;
    }
    const ChainFileLayout layout{chain.format, chain.width, chain.height, chain.firstLevel, key, 0};
    const std::uint64_t bytes = layout.fileBytes();
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (now < _writeAgain || bytes > _limitBytes)
        {
            return false;
        }
    }
    makeRoom(bytes);
    if (!writeFile(key, chain))
    {
        return false;
    }
    {
        const std::lock_guard<std::mutex> lock(_roomMutex);
        _bytes += bytes;
        _bytesSinceScan += bytes;
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    ++_statistics.written;
    _statistics.bytesWritten += bytes;
    return true;
}

bool ChainCache::writeFile(const ContentHash& key, const MipChain& chain)
{
    const std::string path = getPath(key);
    std::error_code error;
    fs::create_directories(fs::path(path).parent_path(), error);
    if (error)
    {
        fail("make the folder", error.message());
        return false;
    }
    const std::string temporary = temporaryName(path);
    errno = 0;
    File file(std::fopen(temporary.c_str(), "wbx"));
    if (!file)
    {
        fail("write into it", std::strerror(errno));
        return false;
    }
    const bool written =
        writeChainFile(key, chain,
                       [&file](const void* bytes, std::size_t count)
                       { return std::fwrite(bytes, 1, count, file.get()) == count; });
    const int cause = errno;
    const bool closed = std::fclose(file.release()) == 0;
    if (written && closed)
    {
        fs::rename(temporary, path, error);
    }
    if (!written || !closed || error)
    {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        fail("write into it", error ? error.message() : std::strerror(cause ? cause : errno));
        return false;
    }
    return true;
}

void ChainCache::makeRoom(std::uint64_t newBytes)
{
    const std::lock_guard<std::mutex> lock(_roomMutex);
    // Other processes write too: look again now and then.
    if (_scanned && _bytes + newBytes <= _limitBytes && _bytesSinceScan <= _limitBytes / 8)
    {
        return;
    }
    const std::uint64_t evicted = removeOldest(newBytes);
    const std::lock_guard<std::mutex> statistics(_mutex);
    _statistics.evicted += evicted;
}

std::uint64_t ChainCache::removeOldest(std::uint64_t newBytes)
{
    std::vector<Entry> entries = scan(_folder);
    _scanned = true;
    _bytesSinceScan = 0;
    _bytes = 0;
    for (const Entry& entry : entries)
    {
        _bytes += entry.bytes;
    }
    if (_bytes + newBytes <= _limitBytes)
    {
        return 0;
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.used < b.used; });
    // A tenth more than needed, so that the next writes need no scan.
    const std::uint64_t goal = _limitBytes - _limitBytes / 10;
    std::uint64_t evicted = 0;
    for (const Entry& entry : entries)
    {
        if (_bytes + newBytes <= goal)
        {
            break;
        }
        std::error_code error;
        evicted += fs::remove(entry.path, error);
        _bytes -= error ? 0 : entry.bytes;
    }
    return evicted;
}

void ChainCache::fail(const std::string& action, const std::string& cause)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    _writeAgain = std::chrono::steady_clock::now() + FailurePause;
    if (!_failed)
    {
        _failed = true;
        _messages.push_back("osgPagedTexture::ChainCache: folder '" + _folder + "': cannot " +
                            action + " (" + cause +
                            "), textures are encoded again at each start; free space, give "
                            "write permission or name another folder");
    }
}

ChainCache::Statistics ChainCache::getStatistics() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _statistics;
}

std::vector<std::string> ChainCache::takeMessages()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_messages, {});
}

} // namespace osgPagedTexture
