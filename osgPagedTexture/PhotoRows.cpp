// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoRows.h>

#include <osgPagedTexture/ExifOrientation.h>
#include <osgPagedTexture/FileBytes.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/JpegCutter.h>
#include <osgPagedTexture/JpegDecoder.h>
#include <osgPagedTexture/JpegFile.h>
#include <osgPagedTexture/LightTables.h>
#include <osgPagedTexture/OiioModule.h>

#include <algorithm>
#include <vector>

namespace osgPagedTexture
{

namespace
{

using Kind = ImageError::Kind;

void checkSize(const std::string& path, const PhotoRowsSettings& settings, std::int64_t width,
               std::int64_t height)
{
    if (width != settings.width || height != settings.height)
    {
        throw ImageError(Kind::Refused, path,
                         "has " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels, but the layout says " + std::to_string(settings.width) +
                             "x" + std::to_string(settings.height) +
                             "; lay out and build again, or update");
    }
}

/// Light of a translucent colour over the background.
std::uint8_t blend(std::uint8_t color, std::uint8_t under, int alpha)
{
    const LightTables& tables = LightTables::get();
    const unsigned int light =
        (tables.light[color] * alpha + tables.light[under] * (255 - alpha) + 127u) / 255u;
    return tables.code[light];
}

/// A picture that has to be there as a whole, since its rows are stored as columns or upwards.
class WholeRows : public PhotoRows
{
public:
    WholeRows(const std::string& path, const PhotoRowsSettings& settings)
        : _settings(settings), _image(readImageFile(path))
    {
        checkSize(path, settings, _image.pixels.width, _image.pixels.height);
    }
    void read(std::uint8_t* row) override
    {
        const Pixels& pixels = _image.pixels;
        convertRow(pixels.row(pixels.height - 1 - _y++), pixels.channels, _settings, row);
    }
    void skip(int rows) override { _y += rows; }
    std::string finish() override { return _image.warning; }

private:
    const PhotoRowsSettings _settings;
    const DecodedImage _image;
    int _y = 0;
};

class JpegRows : public PhotoRows
{
public:
    JpegRows(const std::string& path, std::uint64_t fileBytes, const PhotoRowsSettings& settings)
        : _path(path), _settings(settings), _file(std::make_shared<File>(path)),
          _decoder(_file->decoder)
    {
        ImageLimits limits;
        limits.maxPixels = limits.maxBytes = std::uint64_t(1) << 40; // rows come one by one
        readJpegHeader(_decoder, path);
        checkJpegSize(_decoder, fileBytes, path, limits);
        jpeg_decompress_struct& jpeg = _decoder.info();
        _turned = exifOrientation(_decoder.getExif()) != 1;
        if (_turned)
        {
            return;
        }
        checkSize(path, settings, jpeg.image_width, jpeg.image_height);
        jpeg.out_color_space = jpeg.num_components == 4 ? JCS_CMYK
                               : settings.channels == 1 ? JCS_GRAYSCALE
                               : settings.channels == 3 ? JCS_RGB
                                                        : JCS_EXT_RGBA;
        _inks.resize(jpeg.num_components == 4 ? std::size_t(settings.width) * 7 : 0);
        // What is cut has the file's channels.
        if (settings.cut && (settings.channels == 3 || jpeg.num_components == 1))
        {
            // Whoever holds the cutter also holds what the decoder reads from.
            _cutter = JpegCutter::open(std::shared_ptr<JpegDecoder>(_file, &_file->decoder), path);
        }
        if (!_cutter)
        {
            check(_decoder.start());
        }
    }

    std::shared_ptr<JpegCutter> getCutter() const override { return _cutter; }
    bool isTurned() const { return _turned; }

    void read(std::uint8_t* row) override
    {
        if (_inks.empty())
        {
            check(_decoder.readRow(row));
            return;
        }
        std::uint8_t* rgb = _inks.data() + std::size_t(_settings.width) * 4;
        check(_decoder.readRow(_inks.data()));
        convertCmyk(_inks.data(), _settings.width, _decoder.info().saw_Adobe_marker, rgb);
        convertRow(rgb, 3, _settings, row);
    }
    void skip(int rows) override
    {
        if (_cutter) // libjpeg skips no rows of blocks that are held
        {
            std::vector<std::uint8_t> row(std::size_t(_settings.width) * _settings.channels);
            for (int y = 0; y < rows; ++y)
            {
                read(row.data());
            }
        }
        else if (rows > 0)
        {
            check(_decoder.skipRows(static_cast<unsigned int>(rows)));
        }
    }
    std::string finish() override
    {
        // Finishing would free what is cut from; all was read already.
        check(_cutter || _decoder.finish());
        return _decoder.isWarned() ? damagedJpeg(_path, _decoder.getWarning()).what()
                                   : std::string();
    }

private:
    void check(bool good) const
    {
        if (!good)
        {
            throw damagedJpeg(_path, _decoder.getError());
        }
    }

    const std::string _path;
    const PhotoRowsSettings _settings;
    struct File
    {
        explicit File(const std::string& path) : input(path), decoder(input) {}
        JpegFileInput input;
        JpegDecoder decoder;
    };
    const std::shared_ptr<File> _file;
    JpegDecoder& _decoder;
    std::shared_ptr<JpegCutter> _cutter;
    std::vector<std::uint8_t> _inks; ///< A row of CMYK, and the same in RGB.
    bool _turned = false;
};

} // namespace

void convertRow(const std::uint8_t* source, int channels, const PhotoRowsSettings& settings,
                std::uint8_t* row)
{
    const int target = settings.channels;
    if (channels == target)
    {
        std::copy_n(source, std::size_t(settings.width) * channels, row);
        return;
    }
    const bool hasAlpha = channels == 2 || channels == 4;
    const int lastColor = channels < 3 ? 0 : 2;
    for (int x = 0; x < settings.width; ++x, source += channels, row += target)
    {
        const std::uint8_t alpha = hasAlpha ? source[channels - 1] : 255;
        for (int c = 0; c < std::min(target, 3); ++c)
        {
            const std::uint8_t color = source[std::min(c, lastColor)];
            row[c] =
                alpha == 255 || target == 4 ? color : blend(color, settings.background[c], alpha);
        }
        if (target == 4)
        {
            row[3] = alpha;
        }
    }
}

std::unique_ptr<PhotoRows> openJpegRows(const std::string& path, std::uint64_t fileBytes,
                                        const PhotoRowsSettings& settings)
{
    auto rows = std::make_unique<JpegRows>(path, fileBytes, settings);
    if (rows->isTurned())
    {
        return std::make_unique<WholeRows>(path, settings);
    }
    return rows;
}

std::unique_ptr<PhotoRows> openPhotoRows(const std::string& path, const PhotoRowsSettings& settings)
{
    const FileHead head = readFileHead(path, 2);
    if (isJpeg(head.bytes))
    {
        return openJpegRows(path, head.fileBytes, settings);
    }
    if (auto rows = openPnmRows(path, head.fileBytes, settings))
    {
        return rows;
    }
    if (auto rows = oiioFunctions().openRows(path, head.fileBytes, settings))
    {
        return rows;
    }
    return std::make_unique<WholeRows>(path, settings);
}

} // namespace osgPagedTexture
