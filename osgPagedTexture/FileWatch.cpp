// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FileWatch.h>

#include <osgMultiRender/AllCores.h>

#include <osgPagedTexture/ContentHash.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <utility>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t PieceBytes = 1 << 20;

ChangedFile describe(const std::string& file)
{
    ChangedFile changed{file, {}, {}};
    try
    {
        changed.info = readImageInfo(file);
    }
    catch (const ImageError& error)
    {
        changed.error = error.what();
    }
    return changed;
}

} // namespace

FileWatch::FileWatch(double intervalSeconds) : _interval(intervalSeconds) {}

FileWatch::~FileWatch()
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _ends = true;
    }
    _wake.notify_all();
    if (_thread.joinable())
        _thread.join();
}

bool FileWatch::stampOf(const std::string& file, Stamp& stamp)
{
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    const std::uint64_t bytes = error ? 0 : std::filesystem::file_size(file, error);
    stamp = {std::int64_t(time.time_since_epoch().count()), bytes};
    return !error;
}

/// Never 0; 0 for a file that can't be read.
std::uint64_t FileWatch::contentOf(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> piece(PieceBytes);
    std::uint64_t hash = 1;
    while (stream.read(piece.data(), std::streamsize(piece.size())) || stream.gcount() > 0)
        hash = checksum(piece.data(), std::size_t(stream.gcount()), hash);
    return stream.bad() || !stream.eof() ? 0 : hash | 1;
}

void FileWatch::add(const std::string& file)
{
    std::lock_guard<std::mutex> lock(_mutex);
    Watched& watched = _files[file];
    if (watched.users++ == 0)
    {
        stampOf(file, watched.known);
        watched.last = watched.known;
    }
    if (!_thread.joinable())
        _thread = std::thread(
            [this]
            {
                osgMultiRender::useAllCores();
                run();
            });
}

void FileWatch::remove(const std::string& file)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _files.find(file);
    if (found != _files.end() && --found->second.users == 0)
        _files.erase(found);
}

std::vector<ChangedFile> FileWatch::takeChanged()
{
    std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_changed, {});
}

void FileWatch::run()
{
    std::unique_lock<std::mutex> lock(_mutex);
    while (
        !_wake.wait_for(lock, std::chrono::duration<double>(_interval), [this] { return _ends; }))
    {
        std::vector<std::string> files;
        for (const auto& each : _files)
            files.push_back(each.first);
        lock.unlock();
        for (const std::string& file : files)
            look(file);
        lock.lock();
    }
}

void FileWatch::look(const std::string& file)
{
    Stamp now;
    const bool isThere = stampOf(file, now);
    std::unique_lock<std::mutex> lock(_mutex);
    const auto found = _files.find(file);
    if (_ends || !isThere || found == _files.end())
        return;
    const bool isSettled = found->second.last == now;
    found->second.last = now;
    const bool isNew = !(found->second.known == now);
    const std::uint64_t before = found->second.content;
    if (before != 0 && (!isNew || !isSettled))
        return;
    lock.unlock();
    const std::uint64_t content = contentOf(file);
    // One that changed before its content was known is taken for new.
    const bool isChanged = content != 0 && (before == 0 ? isNew : content != before);
    ChangedFile changed = isChanged ? describe(file) : ChangedFile();
    lock.lock();
    const auto again = _files.find(file);
    if (again == _files.end() || content == 0)
        return;
    if (isChanged)
        _changed.push_back(std::move(changed));
    again->second.content = content;
    again->second.known = now;
}

} // namespace osgPagedTexture
