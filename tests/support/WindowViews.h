// SPDX-License-Identifier: MIT
#pragma once

#include <support/HeadlessViewer.h>

#include <osg/Camera>
#include <osg/Image>
#include <osg/Matrixd>
#include <osgViewer/View>

#include <memory>
#include <string>
#include <vector>

namespace support
{

/// One of the views of a window.
struct WindowView
{
    CameraSpec camera;
    int x, y, width, height; ///< Of the viewport, in pixels from the window's lower left corner.
    std::string name;        ///< Of its camera.
};

/// Views of one scene side by side in one window, without lights of their own.
///
/// Draws once and keeps its context to the end of its life. A window that can't be made is a
/// failure of the running test, and leaves no pictures.
class WindowViews
{
public:
    WindowViews(osg::Node& scene, int width, int height, const std::vector<WindowView>& views);
    ~WindowViews();
    WindowViews(const WindowViews&) = delete;
    WindowViews& operator=(const WindowViews&) = delete;

    /// What the viewport of a view shows; null where nothing was drawn.
    osg::ref_ptr<osg::Image> getPicture(std::size_t view) const;

private:
    struct State;
    std::unique_ptr<State> _state;
};

/// A view with a window and a context of its own, for a CompositeViewer.
class OwnWindow
{
public:
    /// A window that can't be made is a failure of the running test; getView() is null then.
    OwnWindow(osg::Node& scene, const CameraSpec& camera, int width, int height);

    osgViewer::View* getView() const { return _view; }

    /// Of the last frame; null before it. Any thread.
    osg::ref_ptr<osg::Image> getPicture() const;

private:
    osg::ref_ptr<osgViewer::View> _view;
    osg::ref_ptr<osg::Camera::DrawCallback> _capture;
};

/// What a slave camera's matrices have behind those of its viewer.
struct SlaveOffset
{
    osg::Matrixd projection, view;
};

/// The picture of a window whose left and right halves are slave cameras of one viewer, as two
/// projectors or two eyes; `width` is even. Null, and a failure, where it can't be drawn.
osg::ref_ptr<osg::Image> drawSlaves(osg::Node& scene, const CameraSpec& camera, int width,
                                    int height, const SlaveOffset& left, const SlaveOffset& right);

/// As drawSlaves(), of which each shows its half of the camera's picture.
osg::ref_ptr<osg::Image> drawHalves(osg::Node& scene, const CameraSpec& camera, int width,
                                    int height);

/// A camera that draws `node` before the view, into what the caller attaches.
osg::ref_ptr<osg::Camera> makeTargetCamera(osg::Node* node, const CameraSpec& camera, int width,
                                           int height);

} // namespace support
