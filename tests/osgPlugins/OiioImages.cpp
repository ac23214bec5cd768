// SPDX-License-Identifier: MIT
#include <osgPlugins/OiioImages.h>

#include <osg/Texture>
#include <osgDB/Registry>

#include <Imath/half.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace
{

// Every third value is 0, so that alpha 0 and run lengths come about too.
double nextNoise(std::mt19937& random)
{
    const auto bits = random();
    return bits % 3 ? (bits >> 8) / double(0xffffff) : 0.0;
}

} // namespace

osgDB::ReaderWriter* oiioPlugin()
{
    osgDB::Registry* const registry = osgDB::Registry::instance();
    registry->loadLibrary(registry->createLibraryNameForExtension("oiio"));
    osgDB::ReaderWriter* const plugin = registry->getReaderWriterForExtension("exr");
    if (!plugin)
    {
        throw std::runtime_error("osgdb_oiio was not found; set OSG_LIBRARY_PATH");
    }
    return plugin;
}

osg::ref_ptr<osg::Image> makeImage(int width, int height, int channels, GLenum dataType)
{
    constexpr GLenum formats[] = {GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA};
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, formats[channels - 1], dataType, 1);
    return image;
}

int countChannels(const osg::Image& image)
{
    return static_cast<int>(osg::Image::computeNumComponents(image.getPixelFormat()));
}

void fillWithNoise(osg::Image& image)
{
    std::mt19937 random(image.s() * 7919 + image.t());
    for (int row = 0; row < image.t(); ++row)
    {
        for (int column = 0; column < image.s(); ++column)
        {
            for (int channel = 0; channel < countChannels(image); ++channel)
            {
                setValue(image, column, row, channel, nextNoise(random));
            }
        }
    }
}

void fillWithRamps(osg::Image& image)
{
    const int channels = countChannels(image);
    for (int row = 0; row < image.t(); ++row)
    {
        for (int column = 0; column < image.s(); ++column)
        {
            const double x = column / double(image.s() - 1);
            const double y = row / double(image.t() - 1);
            const double values[] = {x, y, 0.5 * (x + y)};
            for (int channel = 0; channel < channels; ++channel)
            {
                const bool isAlpha = channels % 2 == 0 && channel == channels - 1;
                setValue(image, column, row, channel, isAlpha ? 0.5 + 0.5 * y : values[channel]);
            }
        }
    }
}

double getValue(const osg::Image& image, int column, int row, int channel)
{
    const unsigned char* const pixel = image.data(column, row);
    switch (image.getDataType())
    {
    case GL_UNSIGNED_BYTE:
        return pixel[channel] / 255.0;
    case GL_UNSIGNED_SHORT:
        return reinterpret_cast<const unsigned short*>(pixel)[channel] / 65535.0;
    case GL_HALF_FLOAT:
        return reinterpret_cast<const half*>(pixel)[channel];
    case GL_FLOAT:
        return reinterpret_cast<const float*>(pixel)[channel];
    default:
        return std::nan("");
    }
}

void setValue(osg::Image& image, int column, int row, int channel, double value)
{
    unsigned char* const pixel = image.data(column, row);
    switch (image.getDataType())
    {
    case GL_UNSIGNED_BYTE:
        pixel[channel] = static_cast<unsigned char>(std::lround(value * 255.0));
        break;
    case GL_UNSIGNED_SHORT:
        reinterpret_cast<unsigned short*>(pixel)[channel] =
            static_cast<unsigned short>(std::lround(value * 65535.0));
        break;
    case GL_HALF_FLOAT:
        reinterpret_cast<half*>(pixel)[channel] = static_cast<float>(value);
        break;
    default:
        reinterpret_cast<float*>(pixel)[channel] = static_cast<float>(value);
    }
}
