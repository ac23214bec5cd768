// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioFile.h>

#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/BoxReducer.h>
#include <osgPagedTexture/ExifOrientation.h>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cmath>
#include <memory>

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

/// A picture opened by its content.
class OiioReader
{
public:
    OiioReader(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits)
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

    const OIIO::ImageSpec& spec() const { return _input->spec(); }
    std::string format() const { return _input->format_name(); }
    int channels() const { return std::min(spec().nchannels, 4); }
    int alphaChannel() const { return channels() == 2 || channels() == 4 ? channels() - 1 : -1; }
    int orientation() const { return std::clamp(spec().get_int_attribute("Orientation", 1), 1, 8); }

    /// All rows from the top, as 8-bit channels [first, last).
    void readRows(int first, int last, const std::atomic<bool>* cancelled,
                  const BoxReducer::Sink& sink);

private:
    void checkSize(std::uint64_t fileBytes, const ImageLimits& limits) const;
    bool isFloating() const { return spec().format.is_floating_point(); }
    void readBand(int first, int last, int top, int bottom, OIIO::TypeDesc type, void* target);
    void encodeFloats(int first, int channelCount);
    void undoWebp(int first, int channelCount);

    std::string _path;
    std::unique_ptr<OIIO::ImageInput> _input;
    std::vector<std::uint8_t> _band;
    std::vector<float> _floats;
};

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
    if (pixels > limits.maxPixels || pixels * channels() > limits.maxBytes)
    {
        throw ImageError(Kind::Refused, _path,
                         "has " + size + " pixels, more than the limit; store it smaller");
    }
    const std::uint64_t decoded = pixels * header.nchannels * header.format.size();
    if (decoded > freeBytes && decoded / bytesPerByte > fileBytes)
    {
        throw ImageError(Kind::Refused, _path,
                         "says that it has " + size + " pixels, more than its " +
                             std::to_string(fileBytes) +
                             " bytes can hold; copy it from its source again");
    }
}

void OiioReader::readBand(int first, int last, int top, int bottom, OIIO::TypeDesc type,
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

void OiioReader::readRows(int first, int last, const std::atomic<bool>* cancelled,
                          const BoxReducer::Sink& sink)
{
    const OIIO::ImageSpec& header = spec();
    const int count = last - first;
    const std::size_t rowSamples = std::size_t(header.width) * count;
    // Tiles are read in whole rows of tiles; scan lines some at a time, as they were compressed.
    const int bandRows = header.tile_width ? header.tile_height : 64;
    for (int y = 0; y < header.height; y += bandRows)
    {
        if (cancelled && *cancelled)
        {
            throw ImageError(Kind::Cancelled, _path, "no longer needed");
        }
        const int rows = std::min(bandRows, header.height - y);
        const int top = header.y + y;
        _band.resize(rowSamples * rows);
        if (isFloating())
        {
            _floats.resize(_band.size());
            readBand(first, last, top, top + rows, OIIO::TypeFloat, _floats.data());
            encodeFloats(first, count);
        }
        else
        {
            readBand(first, last, top, top + rows, OIIO::TypeUInt8, _band.data());
            undoWebp(first, count);
        }
        for (int row = 0; row < rows; ++row)
        {
            sink(_band.data() + rowSamples * row, y + row);
        }
    }
}

bool isTranslucent(OiioReader& reader)
{
    bool translucent = false;
    const int alpha = reader.alphaChannel();
    const int width = reader.spec().width;
    if (alpha >= 0)
    {
        reader.readRows(alpha, alpha + 1, nullptr,
                        [&](const std::uint8_t* row, int)
                        {
                            translucent = translucent || std::any_of(row, row + width,
                                                                     [](std::uint8_t value)
                                                                     { return value < 255; });
                        });
    }
    return translucent;
}

} // namespace

ImageInfo readOiioInfo(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits,
                       bool lookAtAlpha)
{
    OiioReader reader(path, fileBytes, limits);
    const bool turned = isTransposed(reader.orientation());
    ImageInfo info;
    info.width = turned ? reader.spec().height : reader.spec().width;
    info.height = turned ? reader.spec().width : reader.spec().height;
    info.channels = reader.channels();
    info.format = reader.format();
    info.fileBytes = fileBytes;
    info.translucent = lookAtAlpha ? isTranslucent(reader) : reader.alphaChannel() >= 0;
    return info;
}

DecodedImage readOiioFile(const std::string& path, std::uint64_t fileBytes,
                          const ReadSettings& settings)
{
    OiioReader reader(path, fileBytes, settings.limits);
    const int fullWidth = reader.spec().width;
    const int fullHeight = reader.spec().height;
    const int width = levelSide(fullWidth, settings.reduction);
    const int height = levelSide(fullHeight, settings.reduction);
    const int orientation = reader.orientation();
    const Placement placement = placementOf(width, height, orientation);

    DecodedImage image;
    image.fullWidth = isTransposed(orientation) ? fullHeight : fullWidth;
    image.fullHeight = isTransposed(orientation) ? fullWidth : fullHeight;
    image.fileBytes = fileBytes;
    image.pixels = Pixels(placement.width, placement.height, reader.channels());
    const auto place = [&](const std::uint8_t* row, int y)
    { placeRow(row, width, y, placement, image.pixels); };
    if (settings.reduction <= 0)
    {
        reader.readRows(0, reader.channels(), settings.cancelled, place);
        return image;
    }
    BoxReducer reducer({fullWidth, reader.channels(), double(fullWidth), double(fullHeight), width,
                        height, settings.linearLight},
                       place);
    reader.readRows(0, reader.channels(), settings.cancelled,
                    [&](const std::uint8_t* row, int) { reducer.add(row); });
    return image;
}

} // namespace osgPagedTexture
