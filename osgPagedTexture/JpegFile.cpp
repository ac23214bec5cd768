// SPDX-License-Identifier: MIT
#include <osgPagedTexture/JpegFile.h>

#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/BoxReducer.h>
#include <osgPagedTexture/ExifOrientation.h>
#include <osgPagedTexture/JpegDecoder.h>

#include <algorithm>
#include <memory>

namespace osgPagedTexture
{

namespace
{

using Kind = ImageError::Kind;

} // namespace

ImageError damagedJpeg(const std::string& name, const std::string& cause)
{
    return ImageError(Kind::Damaged, name,
                      "is a damaged JPEG (" + cause + "); copy it from its source again");
}

/// libjpeg needs as much as 6 bytes a pixel besides the pixels for progressive files.
void checkJpegSize(const JpegDecoder& decoder, std::uint64_t fileBytes, const std::string& name,
                   const ImageLimits& limits)
{
    const jpeg_decompress_struct& jpeg = decoder.info();
    constexpr std::uint64_t pixelsPerByte = 1200;
    const std::uint64_t pixels = std::uint64_t(jpeg.image_width) * jpeg.image_height;
    const std::string size =
        std::to_string(jpeg.image_width) + "x" + std::to_string(jpeg.image_height);
    if (pixels > pixelsPerByte * fileBytes)
    {
        throw ImageError(Kind::Refused, name,
                         "says that it has " + size + " pixels, more than its " +
                             std::to_string(fileBytes) +
                             " bytes can hold; copy it from its source again");
    }
    limits.check(name, jpeg.image_width, jpeg.image_height, 3);
}

void readJpegHeader(JpegDecoder& decoder, const std::string& name)
{
    if (!decoder.readHeader())
    {
        throw damagedJpeg(name, decoder.getError());
    }
    const int components = decoder.info().num_components;
    if (components != 1 && components != 3 && components != 4)
    {
        throw ImageError(Kind::Unsupported, name,
                         "is a JPEG of " + std::to_string(components) +
                             " components; convert it to RGB");
    }
}

void convertCmyk(const std::uint8_t* source, int width, bool inkless, std::uint8_t* target)
{
    for (int x = 0; x < width; ++x, source += 4, target += 3)
    {
        const int black = inkless ? source[3] : 255 - source[3];
        for (int c = 0; c < 3; ++c)
        {
            const int value = inkless ? source[c] : 255 - source[c];
            target[c] = static_cast<std::uint8_t>((value * black + 127) / 255);
        }
    }
}

namespace
{

int channelsOf(const jpeg_decompress_struct& jpeg)
{
    return jpeg.num_components == 1 ? 1 : 3;
}

/// Pulls the rows out of the decoder, as grey or RGB.
void decodeRows(JpegDecoder& decoder, const std::string& name, const std::atomic<bool>* cancelled,
                const BoxReducer::Sink& sink)
{
    jpeg_decompress_struct& jpeg = decoder.info();
    const int width = static_cast<int>(jpeg.output_width);
    std::vector<std::uint8_t> row(std::size_t(width) * jpeg.output_components);
    std::vector<std::uint8_t> rgb(jpeg.output_components == 4 ? std::size_t(width) * 3 : 0);
    for (int y = 0; y < static_cast<int>(jpeg.output_height); ++y)
    {
        if (cancelled && *cancelled)
        {
            throw ImageError(Kind::Cancelled, name, "no longer needed");
        }
        if (!decoder.readRow(row.data()))
        {
            throw damagedJpeg(name, decoder.getError());
        }
        if (!rgb.empty())
        {
            convertCmyk(row.data(), width, jpeg.saw_Adobe_marker, rgb.data());
        }
        sink(rgb.empty() ? row.data() : rgb.data(), y);
    }
}

} // namespace

bool readJpegInfo(const std::string& head, std::uint64_t fileBytes, const std::string& name,
                  const ImageLimits& limits, ImageInfo& info)
{
    JpegDecoder decoder(head);
    const bool whole = head.size() >= fileBytes;
    if (!whole && (!decoder.readHeader() || decoder.isWarned()))
    {
        return false;
    }
    if (whole)
    {
        readJpegHeader(decoder, name);
    }
    const jpeg_decompress_struct& jpeg = decoder.info();
    checkJpegSize(decoder, fileBytes, name, limits);
    const bool turned = isTransposed(exifOrientation(decoder.getExif()));
    info.width = static_cast<int>(turned ? jpeg.image_height : jpeg.image_width);
    info.height = static_cast<int>(turned ? jpeg.image_width : jpeg.image_height);
    info.channels = channelsOf(jpeg);
    info.format = "jpeg";
    info.fileBytes = fileBytes;
    // The coefficients of all scans, two bytes each, are held until the last one.
    info.decoderBytes = jpeg.progressive_mode ? std::uint64_t(jpeg.image_width) *
                                                    jpeg.image_height * jpeg.num_components * 2
                                              : 0;
    return true;
}

DecodedImage readJpegBytes(const std::string& bytes, const std::string& name,
                           const ReadSettings& settings)
{
    JpegDecoder decoder(bytes);
    readJpegHeader(decoder, name);
    jpeg_decompress_struct& jpeg = decoder.info();
    checkJpegSize(decoder, bytes.size(), name, settings.limits);

    // Before the scans, as a progressive file may bring another EXIF segment between them.
    const int orientation = exifOrientation(decoder.getExif());
    const int dctReduction = std::clamp(settings.reduction, 0, 3);
    jpeg.scale_num = 8u >> dctReduction;
    jpeg.scale_denom = 8;
    jpeg.out_color_space = jpeg.num_components == 1   ? JCS_GRAYSCALE
                           : jpeg.num_components == 4 ? JCS_CMYK
                                                      : JCS_RGB;
    if (!decoder.start())
    {
        throw damagedJpeg(name, decoder.getError());
    }
    const int fullWidth = static_cast<int>(jpeg.image_width);
    const int fullHeight = static_cast<int>(jpeg.image_height);
    const int width = levelSide(fullWidth, settings.reduction);
    const int height = levelSide(fullHeight, settings.reduction);
    const Placement placement = placementOf(width, height, orientation);

    DecodedImage image;
    image.fullWidth = isTransposed(orientation) ? fullHeight : fullWidth;
    image.fullHeight = isTransposed(orientation) ? fullWidth : fullHeight;
    image.fileBytes = bytes.size();
    image.pixels = Pixels(placement.width, placement.height, channelsOf(jpeg));
    const auto place = [&](const std::uint8_t* row, int y)
    { placeRow(row, width, y, placement, image.pixels); };

    if (static_cast<int>(jpeg.output_width) == width &&
        static_cast<int>(jpeg.output_height) == height)
    {
        decodeRows(decoder, name, settings.cancelled, place);
    }
    else
    {
        // The last column and row of the scaled picture may reach past the edge of the full one.
        const double scale = 1 << dctReduction;
        BoxReducer reducer({static_cast<int>(jpeg.output_width), image.pixels.channels,
                            std::max(fullWidth / scale, 1.0), std::max(fullHeight / scale, 1.0),
                            width, height, settings.linearLight},
                           place);
        decodeRows(decoder, name, settings.cancelled,
                   [&](const std::uint8_t* row, int) { reducer.add(row); });
    }
    if (!decoder.finish())
    {
        throw damagedJpeg(name, decoder.getError());
    }
    image.degraded = decoder.isWarned();
    if (image.degraded)
    {
        image.warning = damagedJpeg(name, decoder.getWarning()).what();
    }
    return image;
}

} // namespace osgPagedTexture
