// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/WriterLimits.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

namespace osgKitsOiio
{

namespace
{

// What is written here was seen with OpenImageIO 2.4.7; a later release that does better is held
// back by it, not broken.

bool hasLuminance(const std::string& format)
{
    return format != "heif"; // fails once it has been opened
}

bool hasLuminanceAlpha(const std::string& format)
{
    return format != "dpx"; // ends the process by an assertion
}

} // namespace

std::vector<int> channelCounts(const std::string& format, int count, bool formatHasAlpha)
{
    std::vector<int> counts;
    if (count == 2 && formatHasAlpha)
    {
        counts = hasLuminanceAlpha(format) ? std::vector<int>{2, 4} : std::vector<int>{4};
    }
    if (count <= 2)
    {
        if (hasLuminance(format))
        {
            counts.push_back(1);
        }
        counts.push_back(3);
        return counts;
    }
    if (count == 4 && formatHasAlpha)
    {
        counts.push_back(4);
    }
    counts.push_back(3);
    return counts;
}

void avoidLosses(const std::string& format, OIIO::ImageSpec& spec)
{
    const OIIO::TypeDesc type = spec.format;
    const bool isWide = type == OIIO::TypeDesc::UINT16 || type == OIIO::TypeDesc::UINT32;
    // RLA's run length coder garbles noise, which floats do not go through. FITS writes halves
    // under another type's header and shifts unsigned integers of 16 bits into signed ones.
    // EXR stores all integers as halves, of 11 bits, where floats keep 16.
    if (format == "rla" || (format == "fits" && (isWide || type == OIIO::TypeDesc::HALF)) ||
        (format == "openexr" && isWide))
    {
        spec.set_format(OIIO::TypeDesc::FLOAT);
    }
    // The writer of plain bitmaps overruns its memory. Icons have 8 bits.
    if (format == "ico")
    {
        spec.set_format(OIIO::TypeDesc::UINT8);
        spec.attribute("ico:PNG", 1);
    }
    // The run length coder garbles the fourth channel.
    if (format == "iff" && isWide)
    {
        spec.attribute("Compression", "none");
    }
}

std::string refusalOf(const std::string& format, const std::string& name, int width, int height,
                      int channels)
{
    // Pixels that the run length coder does not shrink would come back as zeros.
    if (format == "iff" && channels % 2 == 1)
    {
        return "OpenImageIO writes IFF with alpha only; convert the image to RGBA first";
    }
    // The encoder halves the picture five times.
    if (format == "jpeg2000" && (width < 32 || height < 32))
    {
        return "OpenImageIO writes JPEG 2000 from 32x32 pixels, not " + std::to_string(width) +
               "x" + std::to_string(height);
    }
    // It would be an 8-bit PPM under a name that promises floats.
    if (OIIO::Strutil::iends_with(name, ".pfm"))
    {
        return "OpenImageIO reads but does not write pfm; write exr, hdr or tif";
    }
    return {};
}

} // namespace osgKitsOiio
