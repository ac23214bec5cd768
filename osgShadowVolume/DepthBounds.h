// SPDX-License-Identifier: MIT
#pragma once

#include <osg/State>

namespace osgShadowVolume
{

/// While it lives, volumes count only where the surface lies in a range of window depths, as
/// EXT_depth_bounds_test does; nothing where GL lacks it. Draw thread.
class DepthBounds
{
public:
    DepthBounds(const osg::State& state, double nearDepth, double farDepth);
    ~DepthBounds();
    DepthBounds(const DepthBounds&) = delete;
    DepthBounds& operator=(const DepthBounds&) = delete;

private:
    bool _isOn = false;
};

} // namespace osgShadowVolume
