// SPDX-License-Identifier: MIT
// What the image renderings do, on the CPU.
#pragma once

#include <osg/Image>

#include <algorithm>
#include <cmath>

/// Of the nearest pixel, as CLAMP_TO_EDGE.
inline osg::Vec4 at(const osg::Image& image, int x, int y)
{
    return image.getColor(unsigned(std::clamp(x, 0, image.s() - 1)),
                          unsigned(std::clamp(y, 0, image.t() - 1)));
}

inline double luminance(const osg::Vec4& color)
{
    return 0.2126 * color.r() + 0.7152 * color.g() + 0.0722 * color.b();
}

inline osg::Vec4 grey(double value, double alpha = 1.0)
{
    const auto v = float(std::clamp(value, 0.0, 1.0));
    return {v, v, v, float(alpha)};
}

inline osg::Vec4 extreme(const osg::Image& image, int x, int y, int radius, bool isMost)
{
    osg::Vec4 result = at(image, x, y);
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i)
            for (int channel = 0; channel < 4; ++channel)
            {
                const float value = at(image, x + i, y + j)[channel];
                result[channel] =
                    isMost ? std::max(result[channel], value) : std::min(result[channel], value);
            }
    return result;
}

inline osg::Vec4 sobel(const osg::Image& image, int x, int y)
{
    const int mask[3][3] = {{-1, 0, 1}, {-2, 0, 2}, {-1, 0, 1}};
    double dx = 0.0, dy = 0.0;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
        {
            const double bright = luminance(at(image, x + i - 1, y + j - 1));
            dx += mask[j][i] * bright;
            dy += mask[i][j] * bright;
        }
    return grey(0.5 * std::hypot(dx, dy));
}

inline osg::Vec4 sepia(const osg::Vec4& color)
{
    const double bright = 1.15 * luminance(color);
    return {float(std::min(bright, 1.0)), float(std::min(0.84 * bright, 1.0)),
            float(std::min(0.62 * bright, 1.0)), color.a()};
}

inline osg::Vec4 blur(const osg::Image& image, int x, int y, int radius)
{
    osg::Vec4d sum;
    double weights = 0.0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i)
        {
            const double weight = std::exp(-2.0 * (i * i + j * j) / (radius * radius));
            sum += osg::Vec4d(at(image, x + i, y + j)) * weight;
            weights += weight;
        }
    return osg::Vec4(sum / weights);
}

inline osg::Vec4 sharpen(const osg::Image& image, int x, int y)
{
    const int mask[] = {1, 2, 1};
    osg::Vec4d mean;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            mean += osg::Vec4d(at(image, x + i - 1, y + j - 1)) * (mask[i] * mask[j] / 16.0);
    const osg::Vec4 middle = at(image, x, y);
    osg::Vec4 result;
    for (int channel = 0; channel < 3; ++channel)
        result[channel] = float(std::clamp(2.0 * middle[channel] - mean[channel], 0.0, 1.0));
    result.a() = middle.a();
    return result;
}
