// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

#include <string>

namespace osgrender
{

/// How far a picture may be from its reference.
struct Tolerance
{
    double threshold = 2.0 / 255.0; ///< A pixel with a channel off by more counts as off.
    double share = 0.001;           ///< Share of the pixels that may be off, 0 to 1.
    double limit = 8.0 / 255.0;     ///< No channel of any pixel may be off by more.
};

/// Reads "2/255,0.1%,8/255": three non-negative numbers, each plain, a quotient or a percentage.
bool parseTolerance(const std::string& text, Tolerance& tolerance, std::string& error);

/// What a comparison of the red, green and blue channels found.
struct Comparison
{
    bool sameSize = false;
    bool within = false;
    double share = 0.0; ///< Of the pixels, those over the threshold.
    double worst = 0.0; ///< Largest difference of a channel; infinite where only one is finite.
    int worstX = 0;     ///< From the left.
    int worstY = 0;     ///< From the bottom.
    double mean = 0.0;  ///< Over all channels of all pixels where it is finite.

    /// The absolute difference, white where it reaches the hard limit. Null when the sizes differ.
    osg::ref_ptr<osg::Image> difference;
};

Comparison compare(const osg::Image& picture, const osg::Image& reference,
                   const Tolerance& tolerance);

} // namespace osgrender
