// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ImageFile.h>

namespace osgPagedTexture
{

ImageError::ImageError(Kind kind, const std::string& path, const std::string& causeAndRemedy)
    : std::runtime_error("'" + path + "': " + causeAndRemedy), _kind(kind)
{
}

void ImageLimits::check(const std::string& name, std::uint64_t width, std::uint64_t height,
                        unsigned int channels) const
{
    const std::uint64_t pixels = width * height;
    if (pixels > maxPixels || pixels * channels > maxBytes)
    {
        throw ImageError(ImageError::Kind::Refused, name,
                         "has " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels, more than the limit; store it smaller");
    }
}

} // namespace osgPagedTexture
