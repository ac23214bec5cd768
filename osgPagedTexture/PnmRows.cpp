// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoRows.h>

#include <osgPagedTexture/FileBytes.h>
#include <osgPagedTexture/ImageFile.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <vector>

namespace osgPagedTexture
{

namespace
{

/// The numbers of a PNM header: width, height, the highest value. Returns where the pixels start,
/// 0 where this is none.
std::size_t parseHeader(const std::string& head, std::int64_t (&numbers)[3])
{
    std::size_t at = 2;
    for (std::int64_t& number : numbers)
    {
        while (at < head.size() &&
               (std::isspace(static_cast<unsigned char>(head[at])) || head[at] == '#'))
        {
            at = head[at] == '#' ? head.find('\n', at) : at + 1;
        }
        number = 0;
        for (; at < head.size() && head[at] >= '0' && head[at] <= '9' && number < 1 << 30; ++at)
        {
            number = number * 10 + (head[at] - '0');
        }
    }
    const bool closed = at < head.size() && std::isspace(static_cast<unsigned char>(head[at]));
    return closed && numbers[0] > 0 && numbers[1] > 0 ? at + 1 : 0;
}

struct PnmHead
{
    std::int64_t width = 0, height = 0;
    int channels = 0;
    std::size_t pixels = 0; ///< Where they start; 0 where the file is no whole PNM of 8 bits.
};

PnmHead readHead(const std::string& bytes, std::uint64_t fileBytes)
{
    PnmHead head;
    if (bytes.compare(0, 2, "P6") != 0 && bytes.compare(0, 2, "P5") != 0)
    {
        return head;
    }
    std::int64_t numbers[3];
    const std::size_t place = parseHeader(bytes, numbers);
    head.width = numbers[0];
    head.height = numbers[1];
    head.channels = bytes[1] == '6' ? 3 : 1;
    constexpr std::int64_t maxSide = 1 << 30; // so that the product below fits in 64 bits
    const bool whole =
        place > 0 && numbers[2] == 255 && std::max(head.width, head.height) <= maxSide &&
        fileBytes >= place + std::uint64_t(head.width) * std::uint64_t(head.height * head.channels);
    head.pixels = whole ? place : 0;
    return head;
}

/// Uncompressed pixels, which are only copied.
class PnmRows : public PhotoRows
{
public:
    PnmRows(const std::string& path, std::size_t place, int channels,
            const PhotoRowsSettings& settings)
        : _path(path), _settings(settings), _channels(channels),
          _row(channels == settings.channels ? 0 : std::size_t(settings.width) * channels),
          _file(std::fopen(path.c_str(), "rb"), std::fclose)
    {
        if (_file && std::size_t(settings.width) * channels >= BUFSIZ)
        {
            std::setvbuf(_file.get(), nullptr, _IONBF, 0); // a row is one read, and no copy
        }
        check(_file && std::fseek(_file.get(), static_cast<long>(place), SEEK_SET) == 0);
    }

    void read(std::uint8_t* row) override
    {
        const std::size_t bytes = std::size_t(_settings.width) * _channels;
        std::uint8_t* target = _row.empty() ? row : _row.data();
        check(std::fread(target, 1, bytes, _file.get()) == bytes);
        if (!_row.empty())
        {
            convertRow(target, _channels, _settings, row);
        }
    }
    void skip(int rows) override
    {
        check(std::fseek(_file.get(), long(rows) * _settings.width * _channels, SEEK_CUR) == 0);
    }

private:
    void check(bool good) const
    {
        if (!good)
        {
            throw ImageError(ImageError::Kind::Unreadable, _path,
                             "cannot be read to its end; copy it from its source again");
        }
    }

    const std::string _path;
    const PhotoRowsSettings _settings;
    const int _channels;
    std::vector<std::uint8_t> _row; ///< Where pixels are converted.
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> _file;
};

} // namespace

bool readPnmInfo(const std::string& head, std::uint64_t fileBytes, const std::string& path,
                 const ImageLimits& limits, ImageInfo& info)
{
    const PnmHead pnm = readHead(head, fileBytes);
    if (pnm.pixels == 0)
    {
        return false;
    }
    // Not left to OpenImageIO, which reads the whole file when it opens it.
    limits.check(path, pnm.width, pnm.height, pnm.channels);
    info.width = static_cast<int>(pnm.width);
    info.height = static_cast<int>(pnm.height);
    info.channels = pnm.channels;
    info.format = "pnm";
    info.fileBytes = fileBytes;
    return true;
}

std::unique_ptr<PhotoRows> openPnmRows(const std::string& path, std::uint64_t fileBytes,
                                       const PhotoRowsSettings& settings)
{
    constexpr std::size_t headBytes = 1024;
    const PnmHead head = readHead(readFileHead(path, headBytes).bytes, fileBytes);
    if (head.pixels == 0 || head.width != settings.width || head.height != settings.height)
    {
        return nullptr;
    }
    return std::make_unique<PnmRows>(path, head.pixels, head.channels, settings);
}

} // namespace osgPagedTexture
