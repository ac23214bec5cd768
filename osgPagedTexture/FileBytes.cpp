// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FileBytes.h>

#include <osgPagedTexture/ImageFile.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace osgPagedTexture
{

namespace
{

ImageError unreadable(const std::string& path, const std::string& cause)
{
    return ImageError(ImageError::Kind::Unreadable, path, cause);
}

ImageError becameShorter(const std::string& path)
{
    return unreadable(path, "became shorter while it was read; wait until it is written");
}

struct OpenFile
{
    explicit OpenFile(const std::string& path) : _path(path)
    {
        std::error_code error;
        const auto status = std::filesystem::status(path, error);
        if (status.type() == std::filesystem::file_type::not_found)
        {
            throw unreadable(path, "there is no such file; check the path that the model names");
        }
        if (!error && !std::filesystem::is_regular_file(status))
        {
            throw unreadable(path, "is no regular file; name a picture");
        }
        _file.reset(std::fopen(path.c_str(), "rb"));
        const int cause = errno;
        bytes = std::filesystem::file_size(path, error);
        if (!_file || error)
        {
            throw unreadable(path, std::string("cannot be read: ") +
                                       (_file ? error.message() : std::strerror(cause)) +
                                       "; check its permissions");
        }
        if (bytes == 0)
        {
            throw ImageError(ImageError::Kind::Damaged, path,
                             "is empty (0 bytes); copy it from its source again");
        }
    }
    std::string read(std::size_t count)
    {
        std::string text(count, '\0');
        text.resize(std::fread(text.data(), 1, count, _file.get()));
        if (std::ferror(_file.get()))
        {
            throw unreadable(_path, std::string("reading failed: ") + std::strerror(errno) +
                                        "; check the disk");
        }
        return text;
    }
    std::uint64_t bytes = 0;

private:
    struct Close
    {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string _path;
    std::unique_ptr<std::FILE, Close> _file;
};

} // namespace

FileHead readFileHead(const std::string& path, std::size_t count)
{
    OpenFile file(path);
    return {file.read(count), file.bytes};
}

std::string readFileBytes(const std::string& path)
{
    // Far above any picture within the limits, far below what would exhaust memory.
    constexpr std::uint64_t maxFileBytes = std::uint64_t(1) << 31;
    OpenFile file(path);
    if (file.bytes > maxFileBytes)
    {
        throw ImageError(ImageError::Kind::Refused, path,
                         "is larger than 2 GiB; store the picture smaller");
    }
    std::string text = file.read(file.bytes);
    if (text.size() < file.bytes)
    {
        throw becameShorter(path);
    }
    return text;
}

FileHash hashFile(const std::string& path)
{
    OpenFile file(path);
    ContentHasher hasher;
    FileHash hash;
    for (std::string part = file.read(1 << 20); !part.empty(); part = file.read(1 << 20))
    {
        hasher.add(part.data(), part.size());
        hash.fileBytes += part.size();
    }
    if (hash.fileBytes < file.bytes)
    {
        throw becameShorter(path);
    }
    hash.content = hasher.get();
    return hash;
}

} // namespace osgPagedTexture
