// SPDX-License-Identifier: MIT
#include <precision/ImageError.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace precision
{

namespace
{

double getChannel(const osg::Image& picture, int x, int y, int channel)
{
    const unsigned char* const pixel = picture.data(x, y);
    return picture.getDataType() == GL_FLOAT
               ? static_cast<double>(reinterpret_cast<const float*>(pixel)[channel])
               : pixel[channel] / 255.0;
}

void requireComparable(const osg::Image& picture)
{
    const GLenum format = picture.getPixelFormat(), type = picture.getDataType();
    if (!picture.data() || (format != GL_RGB && format != GL_RGBA) ||
        (type != GL_FLOAT && type != GL_UNSIGNED_BYTE))
    {
        throw std::runtime_error("ImageError: not an RGB or RGBA picture of 8 bits or floats");
    }
}

} // namespace

ImageError getImageError(const osg::Image& actual, const osg::Image& expected, double threshold)
{
    requireComparable(actual);
    requireComparable(expected);
    if (actual.s() != expected.s() || actual.t() != expected.t())
    {
        throw std::runtime_error("ImageError: the pictures differ in size");
    }
    ImageError error;
    double squares = 0.0, sum = 0.0, over = 0.0;
    for (int y = 0; y < actual.t(); ++y)
    {
        for (int x = 0; x < actual.s(); ++x)
        {
            double worst = 0.0;
            for (int channel = 0; channel < 3; ++channel)
            {
                const double off = std::fabs(getChannel(actual, x, y, channel) -
                                             getChannel(expected, x, y, channel));
                squares += off * off;
                sum += off;
                worst = off <= worst || std::isnan(worst) ? worst : off;
            }
            over += worst <= threshold ? 0.0 : 1.0;
            error.max = worst <= error.max || std::isnan(error.max) ? error.max : worst;
        }
    }
    const double pixels = static_cast<double>(actual.s()) * actual.t();
    error.rms = std::sqrt(squares / (3.0 * pixels));
    error.meanAbsolute = sum / (3.0 * pixels);
    error.shareOver = over / pixels;
    return error;
}

osg::ref_ptr<osg::Image> boxFilter(const osg::Image& picture, int factor)
{
    requireComparable(picture);
    if (factor < 1 || picture.s() % factor || picture.t() % factor)
    {
        throw std::runtime_error("boxFilter: the picture's size is no multiple of the factor");
    }
    osg::ref_ptr<osg::Image> small = new osg::Image;
    small->allocateImage(picture.s() / factor, picture.t() / factor, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < small->t(); ++y)
    {
        for (int x = 0; x < small->s(); ++x)
        {
            for (int channel = 0; channel < 3; ++channel)
            {
                double sum = 0.0;
                for (int i = 0; i < factor * factor; ++i)
                {
                    sum += getChannel(picture, x * factor + i % factor, y * factor + i / factor,
                                      channel);
                }
                reinterpret_cast<float*>(small->data(x, y))[channel] =
                    static_cast<float>(sum / (factor * factor));
            }
        }
    }
    return small;
}

} // namespace precision
