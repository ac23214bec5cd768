// SPDX-License-Identifier: MIT
#include <support/WindowViews.h>

#include <osgViewer/CompositeViewer>

#include <algorithm>
#include <mutex>

namespace support
{

namespace
{

const osg::Vec4 ClearColor = HeadlessSettings().clearColor;

/// Reads the camera's viewport when it has been drawn.
class Capture : public osg::Camera::DrawCallback
{
public:
    void operator()(osg::RenderInfo& renderInfo) const override
    {
        const osg::Viewport& v = *renderInfo.getCurrentCamera()->getViewport();
        std::lock_guard<std::mutex> lock(_mutex);
        _image = new osg::Image;
        _image->readPixels(int(v.x()), int(v.y()), int(v.width()), int(v.height()), GL_RGBA,
                           GL_UNSIGNED_BYTE);
        EXPECT_NO_GL_ERRORS();
    }

    osg::ref_ptr<osg::Image> get() const
    {
        std::lock_guard<std::mutex> lock(_mutex);
        return _image;
    }

private:
    mutable std::mutex _mutex;
    mutable osg::ref_ptr<osg::Image> _image;
};

/// Null, and a failure, where there is no context.
osg::ref_ptr<osg::GraphicsContext> makeWindow(int width, int height)
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = width;
    traits->height = height;
    traits->depth = 24;
    traits->alpha = 8;
    traits->doubleBuffer = true;
    const osg::ref_ptr<osg::GraphicsContext> window =
        osg::GraphicsContext::createGraphicsContext(traits);
    EXPECT_TRUE(window) << "no window of " << width << " x " << height;
    return window;
}

void prepare(osg::Camera& camera)
{
    camera.setClearColor(ClearColor);
    camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
}

/// Prepares a camera; returns what catches its picture.
osg::ref_ptr<Capture> capture(osg::Camera& camera, osg::GraphicsContext* window, int x, int y,
                              int width, int height)
{
    prepare(camera);
    camera.setGraphicsContext(window);
    camera.setViewport(x, y, width, height);
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    osg::ref_ptr<Capture> capture = new Capture;
    camera.setFinalDrawCallback(capture);
    return capture;
}

/// Four, a second apart: what is kept from frame to frame counts too.
void drawFrames(osgViewer::ViewerBase& viewer)
{
    viewer.realize();
    for (double second = 1.0; second <= 4.0; second += 1.0)
        viewer.frame(second);
}

} // namespace

struct WindowViews::State
{
    osgViewer::CompositeViewer viewer;
    std::vector<osg::ref_ptr<Capture>> captures;
};

WindowViews::WindowViews(osg::Node& scene, int width, int height,
                         const std::vector<WindowView>& views)
    : _state(std::make_unique<State>())
{
    _state->captures.resize(views.size());
    const osg::ref_ptr<osg::GraphicsContext> window = makeWindow(width, height);
    if (!window)
        return;
    _state->viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
        const WindowView& spec = views[i];
        osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
        osg::Camera& camera = *view->getCamera();
        _state->captures[i] = capture(camera, window, spec.x, spec.y, spec.width, spec.height);
        camera.setName(spec.name);
        camera.setViewMatrix(spec.camera.view);
        camera.setProjectionMatrix(spec.camera.projection);
        view->setLightingMode(osg::View::NO_LIGHT);
        view->setSceneData(&scene);
        _state->viewer.addView(view);
    }
    drawFrames(_state->viewer);
}

WindowViews::~WindowViews() = default;

osg::ref_ptr<osg::Image> WindowViews::getPicture(std::size_t view) const
{
    const osg::ref_ptr<Capture>& capture = _state->captures.at(view);
    return capture ? capture->get() : nullptr;
}

OwnWindow::OwnWindow(osg::Node& scene, const CameraSpec& spec, int width, int height)
{
    const osg::ref_ptr<osg::GraphicsContext> window = makeWindow(width, height);
    if (!window)
        return;
    _view = new osgViewer::View;
    osg::Camera& camera = *_view->getCamera();
    _capture = capture(camera, window, 0, 0, width, height);
    camera.setViewMatrix(spec.view);
    camera.setProjectionMatrix(spec.projection);
    _view->setLightingMode(osg::View::NO_LIGHT);
    _view->setSceneData(&scene);
}

osg::ref_ptr<osg::Image> OwnWindow::getPicture() const
{
    return _capture ? static_cast<const Capture&>(*_capture).get() : nullptr;
}

osg::ref_ptr<osg::Image> drawSlaves(osg::Node& scene, const CameraSpec& camera, int width,
                                    int height, const SlaveOffset& left, const SlaveOffset& right)
{
    const osg::ref_ptr<osg::GraphicsContext> window = makeWindow(width, height);
    if (!window)
        return nullptr;
    osgViewer::Viewer viewer;
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer.setLightingMode(osg::View::NO_LIGHT);
    viewer.getCamera()->setViewMatrix(camera.view);
    viewer.getCamera()->setProjectionMatrix(camera.projection);
    osg::ref_ptr<Capture> captures[2];
    const int half = width / 2;
    for (int i = 0; i < 2; ++i)
    {
        osg::ref_ptr<osg::Camera> slave = new osg::Camera;
        captures[i] = capture(*slave, window, half * i, 0, half, height);
        const SlaveOffset& offset = i == 0 ? left : right;
        viewer.addSlave(slave, offset.projection, offset.view);
    }
    viewer.setSceneData(&scene);
    drawFrames(viewer);
    const osg::ref_ptr<osg::Image> joined = new osg::Image;
    joined->allocateImage(width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int i = 0; i < 2; ++i)
    {
        const osg::ref_ptr<osg::Image> picture = captures[i]->get();
        EXPECT_TRUE(picture) << "half " << i << " is not drawn";
        if (!picture)
            return nullptr;
        for (int y = 0; y < height; ++y)
            std::copy_n(picture->data(0, y), 4 * half, joined->data(half * i, y));
    }
    return joined;
}

osg::ref_ptr<osg::Image> drawHalves(osg::Node& scene, const CameraSpec& camera, int width,
                                    int height)
{
    const auto half = [](double shift)
    { return osg::Matrixd::scale(2, 1, 1) * osg::Matrixd::translate(shift, 0, 0); };
    return drawSlaves(scene, camera, width, height, {half(1.0), {}}, {half(-1.0), {}});
}

osg::ref_ptr<osg::Camera> makeTargetCamera(osg::Node* node, const CameraSpec& spec, int width,
                                           int height)
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    prepare(*camera);
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->setViewport(0, 0, width, height);
    camera->setViewMatrix(spec.view);
    camera->setProjectionMatrix(spec.projection);
    camera->addChild(node);
    return camera;
}

} // namespace support
