// SPDX-License-Identifier: MIT
#include "Window.h"

#include "ExitStatus.h"

#include <osg/Camera>
#include <osg/GLExtensions>
#include <osg/Notify>

namespace osgHeadless
{

namespace
{

/// OSG 3.6 takes any function pointer for support of this extension, and libglvnd gives one for
/// every name; multisampled framebuffer objects of cameras would be incomplete.
void dropUnsupportedCoverage(osg::State& state)
{
    if (!osg::isGLExtensionSupported(state.getContextID(),
                                     "GL_NV_framebuffer_multisample_coverage"))
    {
        osg::GLExtensions::Get(state.getContextID(), true)
            ->glRenderbufferStorageMultisampleCoverageNV = nullptr;
    }
}

} // namespace

Window::Window(osg::GraphicsContext::Traits& traits, Backend& backend,
               std::unique_ptr<Surface> surface)
    : _backend(backend), _surface(std::move(surface)), _size{traits.width, traits.height}
{
    _traits = &traits;
    traits.red = traits.green = traits.blue = traits.alpha = traits.stencil = 8;
    traits.depth = 24;
    traits.samples = _surface->getSamples();
    traits.sampleBuffers = traits.samples ? 1 : 0;
    // SingleWindow and its like choose their draw buffer by this after the window is made.
    traits.doubleBuffer = _surface->getColourBuffer() == GL_BACK;

    setState(new osg::State);
    getState()->setGraphicsContext(this);
    if (traits.sharedContext.valid())
    {
        getState()->setContextID(traits.sharedContext->getState()->getContextID());
        incrementContextIDUsageCount(getState()->getContextID());
    }
    else
    {
        getState()->setContextID(createNewContextID());
    }
    getEventQueue()->syncWindowRectangleWithGraphicsContext();

    const std::string file = Capture::getRequestedFile();
    // osgviewer opens its default window when the one asked for fails: that is the wrong picture.
    if (!file.empty() && !traits.pbuffer && !willExitWithFailure())
    {
        _capture = std::make_unique<Capture>(file);
    }
}

Window::~Window()
{
    close(true);
}

bool Window::realizeImplementation()
{
    if (!_surface)
    {
        OSG_WARN << _backend.getPluginName()
                 << ": a closed window cannot be realized; make a new one" << std::endl;
        return false;
    }
    drawToFramebufferObject();
    _realized = true;
    return true;
}

void Window::closeImplementation()
{
    _realized = false;
    if (_capture)
    {
        std::string error;
        if (_surface && !_capture->write(error))
        {
            OSG_WARN << _backend.getPluginName() << ": " << error << std::endl;
            exitWithFailure();
        }
        _capture.reset();
    }
    _surface.reset();
}

bool Window::makeCurrentImplementation()
{
    if (!_surface || !_surface->makeCurrent())
    {
        return false;
    }
    if (!_extensionsComplete)
    {
        setDefaultFboId(_surface->getFramebuffer());
        _backend.completeExtensions(*getState());
        dropUnsupportedCoverage(*getState());
        _extensionsComplete = true;
    }
    return true;
}

bool Window::makeContextCurrentImplementation(osg::GraphicsContext* source)
{
    const auto* window = dynamic_cast<Window*>(source);
    return _surface && _surface->makeCurrent(window ? window->getSurface() : nullptr);
}

bool Window::releaseContextImplementation()
{
    return _surface && _surface->release();
}

void Window::bindPBufferToTextureImplementation(GLenum)
{
    // OSG calls this only for PIXEL_BUFFER_RTT, which WindowingSystem refuses in favour of the
    // copy.
}

void Window::swapBuffersImplementation()
{
    _surface->finishFrame();
    if (_capture)
    {
        _capture->take(*getState(), _surface->getFramebuffer(), _surface->getColourBuffer(),
                       _size.width, _size.height);
    }
}

void Window::runOperations()
{
    applySize();
    GraphicsWindow::runOperations();
}

bool Window::checkEvents()
{
    // Cameras may have joined since; this runs on the main thread, between two culls.
    drawToFramebufferObject();
    return GraphicsWindow::checkEvents();
}

bool Window::setWindowRectangleImplementation(int, int, int width, int height)
{
    std::string error;
    const Limits* limits = _backend.getLimits(error);
    if (!limits || width <= 0 || height <= 0 || width > limits->maxWidth ||
        height > limits->maxHeight)
    {
        OSG_WARN << _backend.getPluginName() << ": a window cannot be resized to " << width << "x"
                 << height << "; the size stays " << _traits->width << "x" << _traits->height
                 << std::endl;
        return false;
    }
    std::lock_guard<std::mutex> lock(_sizeMutex);
    _wantedSize = Size{width, height};
    return true;
}

void Window::setWindowName(const std::string& name)
{
    _traits->windowName = name;
}

// A framebuffer object has no GL_BACK or GL_FRONT: cameras that name one get its only attachment.
void Window::drawToFramebufferObject()
{
    if (!_surface || !_surface->getFramebuffer())
    {
        return;
    }
    for (osg::Camera* camera : getCameras())
    {
        const GLenum draw = camera->getDrawBuffer();
        if (draw != GL_NONE && draw != GL_COLOR_ATTACHMENT0_EXT)
        {
            camera->setDrawBuffer(GL_COLOR_ATTACHMENT0_EXT);
        }
        const GLenum read = camera->getReadBuffer();
        if (read != GL_NONE && read != GL_COLOR_ATTACHMENT0_EXT)
        {
            camera->setReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
        }
    }
}

void Window::applySize()
{
    std::optional<Size> wanted;
    {
        std::lock_guard<std::mutex> lock(_sizeMutex);
        wanted.swap(_wantedSize);
    }
    if (!wanted || (wanted->width == _size.width && wanted->height == _size.height))
    {
        return;
    }
    if (_surface->resize(wanted->width, wanted->height))
    {
        _size = *wanted;
        return;
    }
    OSG_WARN << _backend.getPluginName() << ": no memory for a window of " << wanted->width << "x"
             << wanted->height << "; pictures stay " << _size.width << "x" << _size.height
             << std::endl;
    if (_capture)
    {
        exitWithFailure();
    }
}

} // namespace osgHeadless
