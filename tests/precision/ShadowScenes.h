// SPDX-License-Identifier: MIT
#pragma once

#include <support/HeadlessViewer.h>

#include <osg/Group>
#include <osg/Light>

namespace precision
{

/// White surfaces under light 0, for all ways to draw shadows.
struct ShadowScene
{
    osg::ref_ptr<osg::Group> root; ///< With the light's LightSource.
    osg::ref_ptr<osg::Light> light;
    support::CameraSpec camera;
};

/// A gear on a ground under a spot light. Throws std::runtime_error without the model.
ShadowScene makeModelShadowScene(double aspect);

/// A wall of many triangles with a lamp in its plane, so that rounding decides on which side of
/// each the lamp is, and boxes on the ground beside it.
ShadowScene makeWallShadowScene(double aspect);

} // namespace precision
