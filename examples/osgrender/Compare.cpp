// SPDX-License-Identifier: MIT
#include "Compare.h"

#include "Parse.h"

#include <algorithm>
#include <limits>

namespace osgrender
{

namespace
{

bool parseShare(const std::string& text, double& value)
{
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos)
    {
        double divisor = 0.0;
        if (!parseNumber(text.substr(0, slash), value) ||
            !parseNumber(text.substr(slash + 1), divisor) || divisor <= 0.0)
            return false;
        value /= divisor;
    }
    else if (!text.empty() && text.back() == '%')
    {
        if (!parseNumber(text.substr(0, text.size() - 1), value))
            return false;
        value /= 100.0;
    }
    else if (!parseNumber(text, value))
        return false;
    return value >= 0.0;
}

/// The colour at x from the left and y from the bottom, however the rows are stored.
osg::Vec4 pixel(const osg::Image& image, int x, int y)
{
    const bool topFirst = image.getOrigin() == osg::Image::TOP_LEFT;
    return image.getColor(static_cast<unsigned int>(x),
                          static_cast<unsigned int>(topFirst ? image.t() - 1 - y : y));
}

double channelDifference(float a, float b)
{
    if (a == b || (std::isnan(a) && std::isnan(b)))
        return 0.0;
    const double difference = std::abs(double(a) - double(b));
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

} // namespace

bool parseTolerance(const std::string& text, Tolerance& tolerance, std::string& error)
{
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() == 3 && parseShare(parts[0], tolerance.threshold) &&
        parseShare(parts[1], tolerance.share) && parseShare(parts[2], tolerance.limit))
        return true;
    error =
        "--tolerance '" + text + "': expected threshold,share,limit, for example 2/255,0.1%,8/255";
    return false;
}

Comparison compare(const osg::Image& picture, const osg::Image& reference,
                   const Tolerance& tolerance)
{
    Comparison result;
    result.sameSize = picture.s() == reference.s() && picture.t() == reference.t();
    if (!result.sameSize)
        return result;

    const int width = picture.s(), height = picture.t();
    result.difference = new osg::Image;
    result.difference->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    const double white = std::max(tolerance.limit, 1.0 / 255.0);
    double sum = 0.0;
    long off = 0;
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            const osg::Vec4 a = pixel(picture, x, y), b = pixel(reference, x, y);
            unsigned char* out =
                result.difference->data(static_cast<unsigned int>(x), static_cast<unsigned int>(y));
            double worst = 0.0;
            for (int channel = 0; channel < 3; ++channel)
            {
                const double d = channelDifference(a[channel], b[channel]);
                worst = std::max(worst, d);
                sum += std::isfinite(d) ? d : 0.0;
                out[channel] = static_cast<unsigned char>(255.0 * std::min(d / white, 1.0) + 0.5);
            }
            off += worst > tolerance.threshold;
            if (worst > result.worst)
            {
                result.worst = worst;
                result.worstX = x;
                result.worstY = y;
            }
        }
    }
    const double pixels = double(width) * double(height);
    result.share = pixels > 0.0 ? double(off) / pixels : 0.0;
    result.mean = pixels > 0.0 ? sum / (3.0 * pixels) : 0.0;
    result.within = result.share <= tolerance.share && result.worst <= tolerance.limit;
    return result;
}

} // namespace osgrender
