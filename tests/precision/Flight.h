// SPDX-License-Identifier: MIT
#pragma once

#include "Sweep.h"

#include <chrono>
#include <functional>
#include <vector>

namespace precision
{

using Pictures = std::vector<osg::ref_ptr<osg::Image>>;

/// A flight in real time, some of whose frames are compared with pictures without haste.
struct Flight
{
    int frames;
    int step;  ///< Each so many frames one is compared.
    int first; ///< The first of them.
    std::chrono::milliseconds
        frame; ///< What each of them has; one that takes longer delays the rest.

    /// The pictures to compare with: of the compared frames, one after the other.
    Pictures take(const std::function<osg::ref_ptr<osg::Image>(int frame)>& draw) const;

    /// The number is the mean over the compared frames of the mean difference of channels, of 255;
    /// the time that of a frame without what it waits for its turn.
    Outcome fly(const Pictures& truth,
                const std::function<osg::ref_ptr<osg::Image>(int frame)>& draw) const;
};

} // namespace precision
