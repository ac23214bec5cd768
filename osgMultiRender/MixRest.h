// SPDX-License-Identifier: MIT
// Whether anything moves. Not installed.
#pragma once

#include <osgMultiRender/MixProgram.h>

#include <osg/Matrixd>

#include <map>

namespace osgMultiRender
{

/// Counts for how many frames points, ranges and rules, and what a set of renderings is wanted for,
/// have been the same. Frames, not views: several views of one frame count once.
class MixRest
{
public:
    /// To be called by each view of each frame.
    void see(std::uint64_t mixRevision, const osg::Matrixd& keysToScene, unsigned int frame);
    /// Since how many frames nothing that see() was told has changed.
    unsigned int getQuietFrames(unsigned int frame) const;
    /// Since how many frames in a row the set has been wanted; this one counts as 0.
    unsigned int want(const MixSet& set, unsigned int frame);

private:
    struct Wanted
    {
        unsigned int first = 0, last = 0;
    };

    void forget(unsigned int frame);

    std::uint64_t _mixRevision = 0;
    osg::Matrixd _keysToScene;
    unsigned int _changed = 0; ///< The frame of the last change.
    bool _isFirst = true;
    std::map<MixSet, Wanted> _wanted;
};

} // namespace osgMultiRender
