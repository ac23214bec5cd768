// SPDX-License-Identifier: MIT
#include <osgPagedTexture/StoreFile.h>

#include <osgPagedTexture/TileStore.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace osgPagedTexture
{

namespace
{

using Kind = TileStoreError::Kind;

[[noreturn]] void fail(Kind kind, const std::string& path, const std::string& what)
{
    const int cause = errno;
    std::string remedy = kind == Kind::Unreadable ? "check the path and its permissions"
                                                  : "check the folder's permissions";
    if (cause == ENOSPC || cause == EDQUOT)
    {
        remedy = "make room on the disk";
    }
    else if (cause == EFBIG)
    {
        remedy = "allow larger files (ulimit -f), or use another file system";
    }
    else if (cause == EROFS)
    {
        remedy = "write to a folder that is not read-only";
    }
    else if (cause == EIO)
    {
        remedy = "check the disk";
    }
    throw TileStoreError(kind, "osgPagedTexture::TileStore: '" + path + "' " + what + ": " +
                                   std::strerror(cause) + "; " + remedy);
}

/// Makes a change of the names in a file's folder last.
void syncFolder(const std::string& path)
{
    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // Some network file systems refuse this: the commit is then as durable as they make it.
    const bool failed = descriptor < 0 || (::fsync(descriptor) != 0 && errno == EIO);
    const int cause = errno;
    if (descriptor >= 0)
    {
        ::close(descriptor);
    }
    if (failed)
    {
        errno = cause;
        fail(Kind::Unwritable, folder, "cannot be synced");
    }
}

} // namespace

StoreFile::StoreFile(const std::string& path, Mode mode) : _path(path)
{
    const int flags = mode == Mode::Read     ? O_RDONLY
                      : mode == Mode::Change ? O_RDWR
                                             : O_RDWR | O_CREAT | O_TRUNC;
    // O_NONBLOCK: a pipe of that name must not make the caller wait for ever.
    _descriptor = ::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0666);
    struct stat status = {};
    if (_descriptor < 0)
    {
        fail(mode == Mode::Read ? Kind::Unreadable : Kind::Unwritable, path,
             mode == Mode::Create ? "cannot be created" : "cannot be opened");
    }
    if (::fstat(_descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    {
        ::close(_descriptor);
        throw TileStoreError(Kind::Unreadable, "osgPagedTexture::TileStore: '" + path +
                                                   "' is no regular file; name a packed store");
    }
}

StoreFile::~StoreFile()
{
    if (_descriptor >= 0)
    {
        ::close(_descriptor);
    }
}

std::uint64_t StoreFile::getBytes() const
{
    struct stat status = {};
    if (::fstat(_descriptor, &status) != 0)
    {
        fail(Kind::Unreadable, _path, "cannot be examined");
    }
    return static_cast<std::uint64_t>(status.st_size);
}

bool StoreFile::isReplaced() const
{
    struct stat here = {}, there = {};
    return ::fstat(_descriptor, &here) != 0 || ::stat(_path.c_str(), &there) != 0 ||
           here.st_ino != there.st_ino || here.st_dev != there.st_dev;
}

std::size_t StoreFile::readSome(void* bytes, std::size_t count, std::uint64_t place) const
{
    std::size_t done = 0;
    while (done < count)
    {
        const ssize_t step = ::pread(_descriptor, static_cast<char*>(bytes) + done, count - done,
                                     static_cast<off_t>(place + done));
        if (step < 0 && errno != EINTR)
        {
            fail(Kind::Unreadable, _path, "cannot be read");
        }
        if (step == 0)
        {
            break;
        }
        done += step > 0 ? std::size_t(step) : 0;
    }
    return done;
}

void StoreFile::read(void* bytes, std::size_t count, std::uint64_t place) const
{
    if (readSome(bytes, count, place) < count)
    {
        throw TileStoreError(Kind::Damaged, "osgPagedTexture::TileStore: '" + _path +
                                                "' ends before byte " +
                                                std::to_string(place + count) +
                                                "; it was cut off: copy it again or build it anew");
    }
}

void StoreFile::write(const void* bytes, std::size_t count, std::uint64_t place)
{
    for (std::size_t done = 0; done < count;)
    {
        const ssize_t step = ::pwrite(_descriptor, static_cast<const char*>(bytes) + done,
                                      count - done, static_cast<off_t>(place + done));
        if (step == 0 || (step < 0 && errno != EINTR))
        {
            errno = step == 0 ? ENOSPC : errno;
            fail(Kind::Unwritable, _path, "cannot be written");
        }
        done += step > 0 ? std::size_t(step) : 0;
    }
}

void StoreFile::truncate(std::uint64_t bytes)
{
    if (::ftruncate(_descriptor, static_cast<off_t>(bytes)) != 0)
    {
        fail(Kind::Unwritable, _path, "cannot be cut");
    }
}

void StoreFile::sync()
{
    if (::fdatasync(_descriptor) != 0)
    {
        fail(Kind::Unwritable, _path, "cannot be synced");
    }
}

void StoreFile::moveTo(const std::string& path, bool durable)
{
    if (::rename(_path.c_str(), path.c_str()) != 0)
    {
        fail(Kind::Unwritable, path, "cannot be replaced");
    }
    _path = path;
    if (durable)
    {
        syncFolder(path);
    }
}

void checkRoom(const std::string& path)
{
    constexpr std::size_t block = 4096; // of the file system, whose last one may have room left
    StoreFile file(path, StoreFile::Mode::Change);
    const std::uint64_t bytes = file.getBytes();
    const std::string zeros(block, '\0');
    file.write(zeros.data(), zeros.size(), bytes);
    file.truncate(bytes);
    file.sync();
}

StoreLock::StoreLock(const std::string& storePath, double waitSeconds)
{
    const std::string path = storePath + ".lock";
    _descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (_descriptor < 0)
    {
        fail(Kind::Unwritable, path, "cannot be opened");
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(waitSeconds);
    while (::flock(_descriptor, LOCK_EX | LOCK_NB) != 0)
    {
        if (errno != EWOULDBLOCK && errno != EINTR)
        {
            ::close(_descriptor);
            fail(Kind::Unwritable, path, "cannot be locked");
        }
        if (std::chrono::steady_clock::now() >= end)
        {
            char holder[32] = {};
            const ssize_t length = ::pread(_descriptor, holder, sizeof(holder) - 1, 0);
            ::close(_descriptor);
            throw TileStoreError(Kind::Busy, "osgPagedTexture::TileStore: '" + storePath +
                                                 "' is being written by another process (" +
                                                 (length > 0 ? holder : "unknown") +
                                                 "); wait for its end or let this one wait");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    // The file stays: removing it could let two processes lock two files of one name.
    const std::string holder = "process " + std::to_string(::getpid());
    if (::ftruncate(_descriptor, 0) != 0 ||
        ::pwrite(_descriptor, holder.data(), holder.size(), 0) < 0)
    {
        // The name of the holder is for the message above only; the lock is held without it.
        errno = 0;
    }
}

StoreLock::~StoreLock()
{
    ::close(_descriptor);
}

} // namespace osgPagedTexture
