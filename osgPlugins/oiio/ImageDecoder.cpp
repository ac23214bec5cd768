// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/ImageDecoder.h>

#include <osgPlugins/oiio/PixelLayout.h>
#include <osgPlugins/oiio/Report.h>
#include <osgPlugins/oiio/WebpAlpha.h>

#include <OpenImageIO/strutil.h>

#include <osg/Notify>

#include <algorithm>
#include <new>

namespace osgKitsOiio
{

namespace
{

using ReadResult = osgDB::ReaderWriter::ReadResult;

/// The index of a channel by the last part of its name ("R" of "diffuse.R"), or -1. The channel of
/// the main layer, whose name has one part, goes before those of named layers.
int findChannel(const OIIO::ImageSpec& spec, const char* name)
{
    int found = -1;
    for (int channel = 0; channel < spec.nchannels; ++channel)
    {
        const std::string full = spec.channel_name(channel);
        const auto dot = full.rfind('.');
        const bool inLayer = dot != std::string::npos;
        if (OIIO::Strutil::iequals(inLayer ? full.substr(dot + 1) : full, name))
        {
            if (!inLayer)
            {
                return channel;
            }
            found = found < 0 ? channel : found;
        }
    }
    return found;
}

/// The file's channels that make the picture, 1 to 4 of them.
std::vector<int> pickChannels(const OIIO::ImageSpec& spec, const std::string& name)
{
    if (spec.nchannels <= 4)
    {
        std::vector<int> all(spec.nchannels);
        for (int channel = 0; channel < spec.nchannels; ++channel)
        {
            all[channel] = channel;
        }
        return all;
    }
    std::vector<int> picked = {findChannel(spec, "R"), findChannel(spec, "G"),
                               findChannel(spec, "B")};
    if (std::count(picked.begin(), picked.end(), -1))
    {
        picked = {0, 1, 2};
    }
    const int alpha = findChannel(spec, "A");
    if (alpha >= 0 && !std::count(picked.begin(), picked.end(), alpha))
    {
        picked.push_back(alpha);
    }
    std::string names;
    for (int channel : picked)
    {
        names += (names.empty() ? "" : ", ") + std::string(spec.channel_name(channel));
    }
    OSG_NOTICE << "osgdb_oiio: '" << name << "' has " << spec.nchannels << " channels, taking "
               << names << std::endl;
    return picked;
}

/// Why the picture cannot become an osg::Image; empty where it can.
std::string refusal(const OIIO::ImageSpec& spec, std::uint64_t pixelBytes, const Settings& settings)
{
    if (spec.deep)
    {
        return "deep pixels are not supported; flatten the file, e.g. oiiotool --flatten";
    }
    if (spec.width < 1 || spec.height < 1 || spec.depth < 1 || spec.nchannels < 1)
    {
        return "the picture is empty";
    }
    // Each factor is at most 2^31, so that only the third product can overflow.
    const std::uint64_t limit = settings.maxBytes / pixelBytes;
    const std::uint64_t area = static_cast<std::uint64_t>(spec.width) * spec.height;
    if (area > limit || static_cast<std::uint64_t>(spec.depth) > limit / area)
    {
        const std::string depth = spec.depth > 1 ? "x" + std::to_string(spec.depth) : "";
        return std::to_string(spec.width) + "x" + std::to_string(spec.height) + depth +
               " pixels of " + std::to_string(pixelBytes) + " bytes are more than the limit of " +
               std::to_string(settings.maxBytes >> 20) + " MiB; set oiio.maxMegabytes";
    }
    return {};
}

bool readPixels(OIIO::ImageInput& input, const Settings& settings, const std::vector<int>& channels,
                const Placement& placement, osg::Image& image)
{
    const OIIO::TypeDesc type = typeOf(image.getDataType());
    const OIIO::stride_t sliceBytes = static_cast<OIIO::stride_t>(image.getImageSizeInBytes());
    unsigned char* const target = image.data() + placement.offset;
    const bool contiguous =
        channels.back() - channels.front() + 1 == static_cast<int>(channels.size()) &&
        std::is_sorted(channels.begin(), channels.end());
    if (contiguous)
    {
        return input.read_image(settings.subimage, 0, channels.front(), channels.back() + 1, type,
                                target, placement.xStride, placement.yStride, sliceBytes);
    }
    for (std::size_t i = 0; i < channels.size(); ++i)
    {
        if (!input.read_image(settings.subimage, 0, channels[i], channels[i] + 1, type,
                              target + i * type.size(), placement.xStride, placement.yStride,
                              sliceBytes))
        {
            return false;
        }
    }
    return true;
}

ReadResult decode(OIIO::ImageInput& input, const std::string& name, const Settings& settings)
{
    if (!input.seek_subimage(settings.subimage, 0))
    {
        takeError(input);
        return ReadResult(
            failure(name, "there is no subimage " + std::to_string(settings.subimage)));
    }
    const OIIO::ImageSpec& spec = input.spec();
    const GLenum dataType =
        dataTypeOf(settings.type == OIIO::TypeUnknown ? spec.format : settings.type);
    const int typeBytes = static_cast<int>(typeOf(dataType).size());
    const std::string reason = refusal(spec, std::min(spec.nchannels, 4) * typeBytes, settings);
    if (!reason.empty())
    {
        return ReadResult(failure(name, reason));
    }
    const std::vector<int> channels = pickChannels(spec, name);
    const int count = static_cast<int>(channels.size());
    const Placement placement = placementOf(spec.width, spec.height, count * typeBytes,
                                            spec.get_int_attribute("Orientation", 1));

    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(placement.width, placement.height, spec.depth, pixelFormatOf(count),
                         dataType, 1);
    image->setInternalTextureFormat(internalFormatOf(count, dataType));
    if (!readPixels(input, settings, channels, placement, *image))
    {
        return ReadResult(failure(name, takeError(input)));
    }
    if (input.format_name() == std::string("webp") && count == 4 && dataType == GL_UNSIGNED_BYTE &&
        !spec.get_int_attribute("oiio:UnassociatedAlpha"))
    {
        undoWebpReader(*image);
    }
    return ReadResult(image.get());
}

} // namespace

ReadResult decodeImage(const std::string& format, const std::string& name,
                       OIIO::Filesystem::IOProxy* proxy, const Settings& settings)
{
    try
    {
        const auto input = OIIO::ImageInput::create(format);
        if (!input)
        {
            return ReadResult(failure(name, OIIO::geterror()));
        }
        OIIO::ImageSpec config;
        // OSG blends with unassociated alpha: keep a PNG's or TIFF's colours as they are stored.
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::ImageSpec spec;
        if ((proxy && !input->set_ioproxy(proxy)) || !input->open(name, spec, config))
        {
            return ReadResult(failure(name, takeError(*input)));
        }
        return decode(*input, name, settings);
    }
    catch (const std::bad_alloc&)
    {
        return ReadResult(failure(name, "not enough memory for the picture"));
    }
    catch (const std::exception& exception)
    {
        return ReadResult(failure(name, exception.what()));
    }
}

} // namespace osgKitsOiio
