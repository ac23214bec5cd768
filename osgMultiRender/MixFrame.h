// SPDX-License-Identifier: MIT
// The second pass of a MixedScene whose input is the frame. Not installed.
#pragma once

#include <osgMultiRender/MixDraw.h>

namespace osgUtil
{
class CullVisitor;
} // namespace osgUtil

namespace osgMultiRender
{

/// Of leaves of the pass: last of all in the view, with a state of its own.
osg::ref_ptr<osg::StateSet> makeMixFrameState();

/// Puts the pass into the view, under `stateSet`: when all else is drawn, the frame is copied and
/// drawn over by its mix. `bound` is that of the scene, `keysToScene` leads from the key points.
void addMixFrame(osgUtil::CullVisitor& visitor, osg::StateSet& stateSet,
                 const osg::BoundingSphere& bound, std::shared_ptr<MixResources> resources,
                 std::shared_ptr<const MixSnapshot> snapshot, const osg::Matrixd& keysToScene);

} // namespace osgMultiRender
