// SPDX-License-Identifier: MIT
#include "Capture.h"

#include <osgPlugins/headless/Resolve.h>

#include <osg/ClampColor>
#include <osg/ContextData>
#include <osg/GLExtensions>
#include <osg/Notify>
#include <osg/RenderInfo>
#include <osg/State>
#include <osg/Texture>
#include <osg/Viewport>

#include <chrono>

namespace osgrender
{

namespace
{

std::string glString(GLenum name)
{
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

} // namespace

Capture::Capture(bool floatPixels) : _floatPixels(floatPixels) {}

void Capture::install(osg::Camera& camera, int samples)
{
    camera.setFinalDrawCallback(this);
    if (!_floatPixels)
        return;
    const osg::Viewport* viewport = camera.getViewport();
    _target = new osg::Image;
    _target->allocateImage(int(viewport->width()), int(viewport->height()), 1, GL_RGB, GL_FLOAT);
    _target->setInternalTextureFormat(GL_RGBA32F_ARB);
    const auto count = static_cast<unsigned int>(samples);
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    // The multisampled buffer takes its format from the first call, the image from the second.
    camera.attach(osg::Camera::COLOR_BUFFER, static_cast<GLenum>(GL_RGBA32F_ARB));
    camera.attach(osg::Camera::COLOR_BUFFER, _target.get(), count, count);
    camera.attach(osg::Camera::PACKED_DEPTH_STENCIL_BUFFER,
                  static_cast<GLenum>(GL_DEPTH24_STENCIL8_EXT));
    // Lighting clamps vertex colours whatever the target is.
    camera.getOrCreateStateSet()->setAttributeAndModes(
        new osg::ClampColor(GL_FALSE, GL_FALSE, GL_FALSE));
}

void Capture::beginFrame(bool wanted)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    _wanted = wanted;
    _finished = false;
}

bool Capture::waitForFrame(double seconds)
{
    std::unique_lock<std::mutex> lock(_mutex);
    return _drawn.wait_for(lock, std::chrono::duration<double>(seconds),
                           [this] { return _finished; });
}

osg::ref_ptr<osg::Image> Capture::getPicture() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _picture;
}

void Capture::operator()(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    const std::lock_guard<std::mutex> lock(_mutex);
    countErrors();
    if (_renderer.name.empty())
        _renderer = {glString(GL_VENDOR), glString(GL_RENDERER), glString(GL_VERSION),
                     glString(GL_SHADING_LANGUAGE_VERSION)};
    if (_wanted && _floatPixels)
        _picture = new osg::Image(*_target, osg::CopyOp::DEEP_COPY_ALL);
    else if (_wanted)
        readDefaultFramebuffer(state);
    glFinish();
    countErrors();
    _textureBytes =
        osg::get<osg::TextureObjectManager>(state.getContextID())->getCurrTexturePoolSize();
    _finished = true;
    _drawn.notify_all();
}

void Capture::readDefaultFramebuffer(osg::State& state) const
{
    const osg::GraphicsContext& context = *state.getGraphicsContext();
    const int width = context.getTraits()->width, height = context.getTraits()->height;
    auto* gl = state.get<osg::GLExtensions>();
    const GLuint framebuffer = context.getDefaultFboId();
    GLint samples = 0;
    if (gl->isFrameBufferObjectSupported)
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, framebuffer);
    if (gl->isPBOSupported)
        gl->glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, 0);
    glGetIntegerv(GL_SAMPLES_ARB, &samples);

    _picture = new osg::Image;
    glReadBuffer(framebuffer ? GL_COLOR_ATTACHMENT0_EXT : GL_BACK);
    // Of a pbuffer, too: Mesa's surfaceless platform reads one sample of it otherwise.
    if (samples > 0 && gl->isFrameBufferObjectSupported)
    {
        const osgHeadless::Resolve resolve(*gl, framebuffer, width, height);
        glReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
        _picture->readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE);
        return;
    }
    _picture->readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE);
}

void Capture::countErrors() const
{
    // A lost context reports errors without end.
    constexpr int Most = 100;
    for (int i = 0; i < Most; ++i)
    {
        const GLenum code = glGetError();
        if (code == GL_NO_ERROR)
            return;
        ++_glErrors;
        OSG_WARN << "osgrender: OpenGL error 0x" << std::hex << code << std::dec << " in the frame"
                 << std::endl;
    }
}

} // namespace osgrender
