// SPDX-License-Identifier: MIT
// Any bytes as a JPEG file, at each reduction: a picture of the right size, or an error of one
// line.
#include "fuzz/Require.h"

#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/JpegFile.h>

#include <cstdint>

using namespace osgPagedTexture;

namespace
{

void checkLine(const std::string& line)
{
    require(line.find("'fuzz.jpg': ") == 0, "an error names the file");
    require(line.find('\n') == std::string::npos, "an error is one line");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    ReadSettings settings;
    settings.reduction = static_cast<int>(size % 6);
    settings.linearLight = size % 2;
    settings.limits.maxPixels = 1 << 20; // the time of an input, not the memory
    try
    {
        ImageInfo info;
        readJpegInfo(bytes, bytes.size(), "fuzz.jpg", settings.limits, info);
        const DecodedImage image = readJpegBytes(bytes, "fuzz.jpg", settings);
        require(image.fullWidth == info.width && image.fullHeight == info.height,
                "the header's size is the picture's");
        require(image.pixels.channels == info.channels, "the header's channels are the picture's");
        require(image.pixels.width == levelSide(info.width, settings.reduction) &&
                    image.pixels.height == levelSide(info.height, settings.reduction),
                "the size is that of the level");
        require(image.degraded == !image.warning.empty(), "a warning says what is degraded");
        if (image.degraded)
        {
            checkLine(image.warning);
        }
    }
    catch (const ImageError& error)
    {
        checkLine(error.what());
    }
    return 0;
}
