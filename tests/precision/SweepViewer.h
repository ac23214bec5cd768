// SPDX-License-Identifier: MIT
#pragma once

#include <support/HeadlessViewer.h>

#include <osg/Camera>
#include <osg/Image>

#include <string>

namespace precision
{

/// Draws what cameras have attached, without lights of the viewer's own.
class SweepViewer
{
public:
    /// Throws std::runtime_error where there is no context.
    SweepViewer();

    /// The image of floats that the camera draws its colors into, all NaN: so that nothing drawn is
    /// a failure, not the last round's picture.
    static osg::Image& clear(osg::Camera& camera);

    /// Returns when the camera's image can be read.
    void draw(osg::Camera& camera) { _viewer.render(&camera, {}, 1, 1); }

    /// As GL names it.
    std::string getRenderer() { return _viewer.getRenderer(); }

private:
    support::HeadlessViewer _viewer;
};

} // namespace precision
