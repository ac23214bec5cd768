// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/ImageEncoder.h>

#include <osgPlugins/oiio/PixelLayout.h>
#include <osgPlugins/oiio/Report.h>
#include <osgPlugins/oiio/WebpAlpha.h>
#include <osgPlugins/oiio/WriterLimits.h>

#include <OpenImageIO/filesystem.h>

#include <osg/Notify>

#include <cstring>

namespace osgKitsOiio
{

namespace
{

using WriteResult = osgDB::ReaderWriter::WriteResult;

/// Why an image cannot be written; empty where it can.
std::string refusal(const osg::Image& image)
{
    if (!image.data() || image.s() < 1 || image.t() < 1)
    {
        return "the image has no pixels";
    }
    if (image.r() > 1)
    {
        return "a volume of " + std::to_string(image.r()) + " slices; write its slices one by one";
    }
    if (image.isCompressed())
    {
        return "the pixels are compressed for the GPU; write .dds, or decompress the image first";
    }
    if (!channelOrderOf(image.getPixelFormat()).count ||
        typeOf(image.getDataType()) == OIIO::TypeUnknown)
    {
        char names[64];
        std::snprintf(names, sizeof names, "pixel format 0x%04x of type 0x%04x",
                      image.getPixelFormat(), image.getDataType());
        return std::string(names) + " cannot be written; convert the image to RGB or RGBA first";
    }
    return {};
}

/// Which component of a pixel goes into each of count channels; the last of 2 or 4 is alpha.
std::vector<int> channelSources(const ChannelOrder& order, int count)
{
    std::vector<int> sources(count);
    for (int channel = 0; channel < count; ++channel)
    {
        const bool isAlpha = count % 2 == 0 && channel == count - 1;
        const int grey = order.index[0];
        sources[channel] = isAlpha           ? order.index[order.count - 1]
                           : order.count < 3 ? grey
                                             : order.index[channel];
    }
    return sources;
}

/// The pixels as OpenImageIO takes them: from the top row down, maybe by a negative stride.
struct Pixels
{
    std::vector<unsigned char> copy; ///< Empty where the image's own memory serves.
    const unsigned char* top = nullptr;
    OIIO::stride_t xStride = 0;
    OIIO::stride_t yStride = 0;
};

Pixels arrangePixels(const osg::Image& image, const std::vector<int>& sources)
{
    const int componentBytes = static_cast<int>(typeOf(image.getDataType()).size());
    const OIIO::stride_t pixelBytes = componentBytes * channelOrderOf(image.getPixelFormat()).count;
    const bool bottomUp = image.getOrigin() == osg::Image::BOTTOM_LEFT;
    Pixels pixels;
    pixels.top = image.data(0, bottomUp ? image.t() - 1 : 0);
    pixels.xStride = pixelBytes;
    pixels.yStride = static_cast<OIIO::stride_t>(image.getRowStepInBytes()) * (bottomUp ? -1 : 1);

    bool inPlace = true;
    for (std::size_t i = 0; i < sources.size(); ++i)
    {
        inPlace = inPlace && sources[i] == static_cast<int>(i);
    }
    if (inPlace)
    {
        return pixels;
    }
    const std::size_t newBytes = sources.size() * componentBytes;
    pixels.copy.resize(newBytes * image.s() * image.t());
    unsigned char* out = pixels.copy.data();
    for (int row = 0; row < image.t(); ++row)
    {
        const unsigned char* pixel = pixels.top + row * pixels.yStride;
        for (int column = 0; column < image.s(); ++column, pixel += pixelBytes)
        {
            for (int source : sources)
            {
                std::memcpy(out, pixel + source * componentBytes, componentBytes);
                out += componentBytes;
            }
        }
    }
    pixels.top = pixels.copy.data();
    pixels.xStride = newBytes;
    pixels.yStride = pixels.xStride * image.s();
    return pixels;
}

OIIO::ImageSpec makeSpec(const osg::Image& image, const std::string& format, int channels,
                         const Settings& settings)
{
    const OIIO::TypeDesc own = typeOf(image.getDataType());
    OIIO::ImageSpec spec(image.s(), image.t(), channels,
                         settings.type == OIIO::TypeUnknown ? own : settings.type);
    // Without this PNG and others divide the colours by alpha.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (settings.quality)
    {
        spec.attribute("CompressionQuality", settings.quality);
    }
    if (!settings.compression.empty())
    {
        spec.attribute("Compression", settings.compression);
    }
    avoidLosses(format, spec);
    return spec;
}

bool writePixels(OIIO::ImageOutput& output, const osg::Image& image, int channels)
{
    const ChannelOrder order = channelOrderOf(image.getPixelFormat());
    const OIIO::TypeDesc type = typeOf(image.getDataType());
    const Pixels pixels = arrangePixels(image, channelSources(order, channels));
    if (channels < 4 || output.format_name() != std::string("webp"))
    {
        return output.write_image(type, pixels.top, pixels.xStride, pixels.yStride);
    }
    std::vector<unsigned char> bytes(std::size_t(4) * image.s() * image.t());
    OIIO::convert_image(4, image.s(), image.t(), 1, pixels.top, type, pixels.xStride,
                        pixels.yStride, OIIO::AutoStride, bytes.data(), OIIO::TypeDesc::UINT8, 4,
                        OIIO::AutoStride, OIIO::AutoStride);
    undoWebpWriter(bytes.data(), std::size_t(image.s()) * image.t());
    return output.write_image(OIIO::TypeDesc::UINT8, bytes.data());
}

WriteResult encode(const osg::Image& image, const std::string& format, const std::string& name,
                   OIIO::Filesystem::IOProxy* proxy, const Settings& settings)
{
    const ChannelOrder order = channelOrderOf(image.getPixelFormat());
    auto output = OIIO::ImageOutput::create(format);
    if (!output)
    {
        return WriteResult(failure(name, OIIO::geterror()));
    }
    std::string firstError;
    for (int channels : channelCounts(format, order.count, output->supports("alpha")))
    {
        output = OIIO::ImageOutput::create(format);
        if ((proxy && !output->set_ioproxy(proxy)) ||
            !output->open(name, makeSpec(image, format, channels, settings)))
        {
            const std::string error = takeError(*output);
            firstError = firstError.empty() ? error : firstError;
            continue;
        }
        if (order.count % 2 == 0 && channels % 2 == 1)
        {
            OSG_NOTICE << "osgdb_oiio: '" << name << "': " << format
                       << " has no alpha, which is left out" << std::endl;
        }
        if (!writePixels(*output, image, channels) || !output->close())
        {
            return WriteResult(failure(name, takeError(*output)));
        }
        return WriteResult(WriteResult::FILE_SAVED);
    }
    return WriteResult(failure(name, firstError));
}

} // namespace

WriteResult encodeImage(const osg::Image& image, const std::string& format, const std::string& name,
                        OIIO::Filesystem::IOProxy* proxy, const Settings& settings)
{
    std::string reason = refusal(image);
    if (reason.empty())
    {
        reason = refusalOf(format, name, image.s(), image.t(),
                           channelOrderOf(image.getPixelFormat()).count);
    }
    if (!reason.empty())
    {
        return WriteResult(failure(name, reason));
    }
    const bool existed = proxy || OIIO::Filesystem::exists(name);
    WriteResult result;
    try
    {
        result = encode(image, format, name, proxy, settings);
    }
    catch (const std::exception& exception)
    {
        result = WriteResult(failure(name, exception.what()));
    }
    if (!result.success() && !existed && OIIO::Filesystem::exists(name))
    {
        OIIO::Filesystem::remove(name);
    }
    return result;
}

} // namespace osgKitsOiio
