// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

#include <gtest/gtest.h>

#include <string>

namespace support
{

/// How far two pictures are apart. Values are in units of full scale (255 for RGBA8, 1 for float).
struct ImageDifference
{
    unsigned int pixels = 0;     ///< Of the picture.
    unsigned int pixelsOver = 0; ///< With a channel off by more than the threshold.
    double worst = 0.0;          ///< Largest difference of a channel; infinity if one is NaN.
    int worstX = 0;              ///< Pixel of `worst`, from the left.
    int worstY = 0;              ///< From the bottom.

    double getShareOver() const { return pixels ? double(pixelsOver) / pixels : 0.0; }
};

/// Compares two pictures of the same size and of 8 bits or floats, by any of their first four
/// channels. `threshold` is the difference that counts; a rounding of half a step is allowed for.
ImageDifference difference(const osg::Image& actual, const osg::Image& expected, double threshold);

/// Says whether a picture is the expected one: few pixels a little off are fine, none far off.
///
///     EXPECT_TRUE(CompareImage()(actual, expected, "sphereUnderSpot"));
///
/// On failure the message has the worst pixel and the count, and
/// `<name>.{actual,expected,diff}.png` are written into build/images. Callable from one thread at a
/// time for one name.
struct CompareImage
{
    double threshold = 2.0 / 255.0; ///< Of a channel; 1 is full scale.
    double share = 0.001;           ///< Of the pixels, allowed over the threshold.
    double hardLimit = 8.0 / 255.0; ///< For any channel of any pixel.

    testing::AssertionResult operator()(const osg::Image* actual, const osg::Image* expected,
                                        const std::string& name) const;
};

/// Writes a picture as build/images/<name>.png, floats clamped; returns the path.
std::string writeImage(const osg::Image& image, const std::string& name);

} // namespace support
