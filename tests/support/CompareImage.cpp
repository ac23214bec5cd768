// SPDX-License-Identifier: MIT
#include <support/CompareImage.h>

#include <osgDB/FileUtils>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace support
{

namespace
{

bool isComparable(const osg::Image& a, const osg::Image& b)
{
    return a.s() == b.s() && a.t() == b.t() && a.getPixelFormat() == b.getPixelFormat() &&
           a.getDataType() == b.getDataType() &&
           (a.getDataType() == GL_UNSIGNED_BYTE || a.getDataType() == GL_FLOAT);
}

double channel(const osg::Image& image, int x, int y, unsigned int c)
{
    const unsigned char* pixel = image.data(x, y);
    if (image.getDataType() == GL_FLOAT)
        return reinterpret_cast<const float*>(pixel)[c];
    return pixel[c] / 255.0;
}

double pixelDifference(const osg::Image& a, const osg::Image& b, int x, int y)
{
    const unsigned int channels = osg::Image::computeNumComponents(a.getPixelFormat());
    double worst = 0.0;
    for (unsigned int c = 0; c < channels; ++c)
    {
        const double d = std::abs(channel(a, x, y, c) - channel(b, x, y, c));
        worst = std::max(worst, std::isnan(d) ? std::numeric_limits<double>::infinity() : d);
    }
    return worst;
}

/// Differences of the color, eight times enlarged, on black.
osg::ref_ptr<osg::Image> differencePicture(const osg::Image& a, const osg::Image& b)
{
    osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->allocateImage(a.s(), a.t(), 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    const unsigned int channels = osg::Image::computeNumComponents(a.getPixelFormat());
    for (int y = 0; y < a.t(); ++y)
    {
        for (int x = 0; x < a.s(); ++x)
        {
            for (unsigned int c = 0; c < 3; ++c)
            {
                const unsigned int k = std::min(c, channels - 1);
                const double d = std::abs(channel(a, x, y, k) - channel(b, x, y, k));
                picture->data(x, y)[c] = std::isnan(d) ? 255 : std::min(8.0 * 255.0 * d, 255.0);
            }
        }
    }
    return picture;
}

std::string pixelText(const osg::Image& image, int x, int y)
{
    std::string text = "(";
    for (unsigned int c = 0; c < osg::Image::computeNumComponents(image.getPixelFormat()); ++c)
    {
        const double value = channel(image, x, y, c);
        text += (c ? " " : "") + (image.getDataType() == GL_FLOAT
                                      ? std::to_string(value)
                                      : std::to_string(int(std::lround(value * 255.0))));
    }
    return text + ")";
}

} // namespace

ImageDifference difference(const osg::Image& actual, const osg::Image& expected, double threshold)
{
    ImageDifference result;
    result.pixels = actual.s() * actual.t();
    const double limit = threshold + 1e-6; // 2/255 itself is no more than 2/255
    for (int y = 0; y < actual.t(); ++y)
    {
        for (int x = 0; x < actual.s(); ++x)
        {
            const double d = pixelDifference(actual, expected, x, y);
            result.pixelsOver += d > limit;
            if (d > result.worst)
            {
                result.worst = d;
                result.worstX = x;
                result.worstY = y;
            }
        }
    }
    return result;
}

testing::AssertionResult CompareImage::operator()(const osg::Image* actual,
                                                  const osg::Image* expected,
                                                  const std::string& name) const
{
    if (!actual || !expected)
        return testing::AssertionFailure() << name << ": there is no picture";
    if (!isComparable(*actual, *expected))
        return testing::AssertionFailure()
               << name << ": " << actual->s() << "x" << actual->t() << " of format "
               << actual->getPixelFormat() << " cannot be compared with " << expected->s() << "x"
               << expected->t() << " of format " << expected->getPixelFormat();
    const ImageDifference d = difference(*actual, *expected, threshold);
    if (d.getShareOver() <= share && d.worst <= hardLimit + 1e-6)
        return testing::AssertionSuccess();
    const std::string path = writeImage(*actual, name + ".actual");
    writeImage(*expected, name + ".expected");
    writeImage(*differencePicture(*actual, *expected), name + ".diff");
    std::ostringstream text;
    text << name << ": " << d.pixelsOver << " of " << d.pixels << " pixels ("
         << 100.0 * d.getShareOver() << " %, allowed " << 100.0 * share << " %) off by more than "
         << threshold * 255.0 << "/255; worst " << d.worst * 255.0 << "/255 (allowed "
         << hardLimit * 255.0 << ") at " << d.worstX << "," << d.worstY << ": "
         << pixelText(*actual, d.worstX, d.worstY) << " for "
         << pixelText(*expected, d.worstX, d.worstY) << "; see " << path;
    return testing::AssertionFailure() << text.str();
}

std::string writeImage(const osg::Image& image, const std::string& name)
{
    osg::ref_ptr<osg::Image> bytes = new osg::Image;
    const unsigned int channels = osg::Image::computeNumComponents(image.getPixelFormat());
    const unsigned int written = std::min(channels, 3u); // blending must not hide a picture
    bytes->allocateImage(image.s(), image.t(), 1, written == 3 ? GL_RGB : GL_LUMINANCE,
                         GL_UNSIGNED_BYTE, 1);
    for (int y = 0; y < image.t(); ++y)
    {
        for (int x = 0; x < image.s(); ++x)
        {
            for (unsigned int c = 0; c < (written == 3 ? 3u : 1u); ++c)
            {
                const double value = channel(image, x, y, c);
                bytes->data(x, y)[c] = std::lround(255.0 * std::clamp(value, 0.0, 1.0));
            }
        }
    }
    std::string file = name;
    std::replace(file.begin(), file.end(), '/', '.');
    const std::string path = std::string(OSGKITS_IMAGE_FOLDER "/") + file + ".png";
    osgDB::makeDirectory(OSGKITS_IMAGE_FOLDER);
    osgDB::writeImageFile(*bytes, path);
    return path;
}

} // namespace support
