// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioReader.h>

#include <OpenImageIO/strutil.h>

#include <cmath>

namespace osgPagedTexture
{

namespace
{

using Kind = ImageError::Kind;

/// Versions 1 of Targa have no signature, so that any bytes may pass for one.
bool isTargaName(const std::string& path)
{
    const std::string name = OIIO::Strutil::lower(path);
    return OIIO::Strutil::ends_with(name, ".tga") || OIIO::Strutil::ends_with(name, ".tpic");
}

} // namespace

OiioReader::OiioReader(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits)
    : _path(path)
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // colours as they are stored
    _input = OIIO::ImageInput::open(path, &config);
    if (!_input || (_input->format_name() == std::string("targa") && !isTargaName(path)) ||
        _input->format_name() == std::string("jpeg"))
    {
        OIIO::geterror();
        throw ImageError(Kind::Damaged, path,
                         "is no picture of a known format; copy it from its source again or "
                         "convert it to PNG");
    }
    _input->threads(1); // the workers are the threads
    checkSize(fileBytes, limits);
}

void OiioReader::checkSize(std::uint64_t fileBytes, const ImageLimits& limits) const
{
    const OIIO::ImageSpec& header = spec();
    if (header.deep || header.width < 1 || header.height < 1 || header.nchannels < 1 ||
        header.depth > 1)
    {
        throw ImageError(Kind::Unsupported, _path,
                         "is empty, deep or a volume; convert it to a flat picture");
    }
    constexpr std::uint64_t bytesPerByte = 1100;
    constexpr std::uint64_t freeBytes = 64 << 20;
    const std::uint64_t pixels = std::uint64_t(header.width) * header.height;
    const std::string size = std::to_string(header.width) + "x" + std::to_string(header.height);
    limits.check(_path, header.width, header.height, channels());
    const std::uint64_t decoded = pixels * header.nchannels * header.format.size();
    if (decoded > freeBytes && decoded / bytesPerByte > fileBytes)
    {
        throw ImageError(Kind::Refused, _path,
                         "says that it has " + size + " pixels, more than its " +
                             std::to_string(fileBytes) +
                             " bytes can hold; copy it from its source again");
    }
}

void OiioReader::readInto(int first, int last, int top, int bottom, OIIO::TypeDesc type,
                          void* target)
{
    const OIIO::ImageSpec& header = spec();
    const bool read =
        header.tile_width
            ? _input->read_tiles(0, 0, header.x, header.x + header.width, top, bottom, header.z,
                                 header.z + 1, first, last, type, target)
            : _input->read_scanlines(0, 0, top, bottom, header.z, first, last, type, target);
    if (!read)
    {
        throw ImageError(Kind::Damaged, _path,
                         "is damaged (" +
                             OIIO::Strutil::replace(_input->geterror(), "\n", " ", true) +
                             "); copy it from its source again");
    }
}

/// Floating point holds linear light.
void OiioReader::encodeFloats(int first, int channelCount)
{
    const int alpha = alphaChannel();
    for (std::size_t i = 0; i < _floats.size(); ++i)
    {
        const float value = _floats[i] >= 0.0f ? std::min(_floats[i], 1.0f) : 0.0f; // NaN: 0
        const bool isAlpha = first + static_cast<int>(i % channelCount) == alpha;
        const float code = isAlpha               ? value
                           : value <= 0.0031308f ? value * 12.92f
                                                 : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
        _band[i] = static_cast<std::uint8_t>(code * 255.0f + 0.5f);
    }
}

/// OpenImageIO's WebP reader multiplies alpha in whatever it is told.
void OiioReader::undoWebp(int first, int channelCount)
{
    if (first != 0 || channelCount != 4 || format() != "webp" ||
        spec().get_int_attribute("oiio:UnassociatedAlpha"))
    {
        return;
    }
    for (std::size_t at = 0; at < _band.size(); at += 4)
    {
        const int alpha = _band[at + 3];
        for (int c = 0; c < 3 && alpha; ++c)
        {
            _band[at + c] =
                static_cast<std::uint8_t>(std::min((_band[at + c] * 255 + alpha / 2) / alpha, 255));
        }
    }
}

const std::uint8_t* OiioReader::readBand(int y, int first, int last)
{
    const OIIO::ImageSpec& header = spec();
    const int count = last - first;
    const int rows = std::min(bandRows(), header.height - y);
    const int top = header.y + y;
    _band.resize(std::size_t(header.width) * count * rows);
    if (isFloating())
    {
        _floats.resize(_band.size());
        readInto(first, last, top, top + rows, OIIO::TypeFloat, _floats.data());
        encodeFloats(first, count);
    }
    else
    {
        readInto(first, last, top, top + rows, OIIO::TypeUInt8, _band.data());
        undoWebp(first, count);
    }
    return _band.data();
}

void OiioReader::readRows(int first, int last, const std::atomic<bool>* cancelled,
                          const BoxReducer::Sink& sink)
{
    const int height = spec().height;
    const std::size_t rowSamples = std::size_t(spec().width) * (last - first);
    for (int y = 0; y < height; y += bandRows())
    {
        if (cancelled && *cancelled)
        {
            throw ImageError(Kind::Cancelled, _path, "no longer needed");
        }
        const std::uint8_t* band = readBand(y, first, last);
        for (int row = 0; row < std::min(bandRows(), height - y); ++row)
        {
            sink(band + rowSamples * row, y + row);
        }
    }
}

} // namespace osgPagedTexture
