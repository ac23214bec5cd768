// SPDX-License-Identifier: MIT
// Key points as things to be seen. Not installed.
#pragma once

#include <osgMultiRender/KeyPoints.h>

#include <osg/Node>
#include <osg/Vec3d>

#include <vector>

namespace osgMultiRender
{

/// Red spheres of a radius at the points that count, and red lines where the mode joins them.
osg::ref_ptr<osg::Node> makeMixMarkers(const std::vector<osg::Vec3d>& points, KeyMode mode,
                                       bool lines, float radius);

} // namespace osgMultiRender
