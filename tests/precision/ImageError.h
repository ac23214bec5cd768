// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

namespace precision
{

/// How far a picture is from another, over the first three channels of all pixels.
/// In units of full scale: 1 for floats, 255 for 8 bits.
struct ImageError
{
    double rms = 0.0;
    double max = 0.0;
    double meanAbsolute = 0.0;
    double shareOver = 0.0; ///< Of the pixels, with a channel off by more than the threshold.
};

/// Throws std::runtime_error for pictures that differ in size, or have no pixels or other types
/// than 8-bit and float ones. A NaN makes rms, max and meanAbsolute NaN.
ImageError getImageError(const osg::Image& actual, const osg::Image& expected,
                         double threshold = 2.0 / 255.0);

/// Averages blocks of factor x factor pixels into a float RGB picture. Throws std::runtime_error as
/// getImageError() does, and where the size is no multiple of the factor.
osg::ref_ptr<osg::Image> boxFilter(const osg::Image& picture, int factor);

} // namespace precision
