// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/WebpAlpha.h>

#include <algorithm>
#include <cmath>

namespace osgKitsOiio
{

namespace
{

double toLinear(double value)
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double toSrgb(double value)
{
    return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

} // namespace

void undoWebpReader(osg::Image& image)
{
    const std::size_t bytes = image.getTotalSizeInBytes();
    for (std::size_t at = 0; at < bytes; at += 4)
    {
        unsigned char* const pixel = image.data() + at;
        const int alpha = pixel[3];
        for (int channel = 0; channel < 3 && alpha > 0; ++channel)
        {
            const int colour = (pixel[channel] * 255 + alpha / 2) / alpha;
            pixel[channel] = static_cast<unsigned char>(std::min(colour, 255));
        }
    }
}

void undoWebpWriter(unsigned char* pixels, std::size_t count)
{
    double linear[256];
    for (int value = 0; value < 256; ++value)
    {
        linear[value] = toLinear(value / 255.0);
    }
    for (unsigned char* pixel = pixels; pixel != pixels + 4 * count; pixel += 4)
    {
        for (int channel = 0; channel < 3 && pixel[3] < 255; ++channel)
        {
            const double associated = toSrgb(linear[pixel[channel]] * pixel[3] / 255.0);
            pixel[channel] = static_cast<unsigned char>(std::lround(associated * 255.0));
        }
    }
}

} // namespace osgKitsOiio
