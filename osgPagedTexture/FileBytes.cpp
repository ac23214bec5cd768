// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FileBytes.h>

#include <osgPagedTexture/ImageFile.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

namespace osgPagedTexture
{

namespace
{

ImageError unreadable(const std::string& path, const std::string& cause)
{
    return ImageError(ImageError::Kind::Unreadable, path, cause);
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
        text.resize(readInto(text.data(), count));
        return text;
    }
    std::size_t readInto(char* target, std::size_t count)
    {
        const std::size_t got = std::fread(target, 1, count, _file.get());
        if (std::ferror(_file.get()))
        {
            throw unreadable(_path, std::string("reading failed: ") + std::strerror(errno) +
                                        "; check the disk");
        }
        return got;
    }
    /// Throws where fewer bytes came than there were at first.
    void checkWhole(std::uint64_t got) const
    {
        if (got < bytes)
        {
            throw unreadable(_path, "became shorter while it was read; wait until it is written");
        }
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
    file.checkWhole(text.size());
    return text;
}

FileHash hashFile(const std::string& path)
{
    OpenFile file(path);
    HashStream stream;
    std::vector<char> piece(1 << 20);
    FileHash hash;
    while (const std::size_t got = file.readInto(piece.data(), piece.size()))
    {
        stream.add(piece.data(), got);
        hash.fileBytes += got;
    }
    file.checkWhole(hash.fileBytes);
    hash.content = stream.get();
    return hash;
}

} // namespace osgPagedTexture
