// SPDX-License-Identifier: MIT
#define GL_GLEXT_PROTOTYPES
#include "OSMesaSurface.h"

#include <GL/glext.h>

#include <atomic>
#include <new>

namespace osgOSMesa
{

namespace
{

// OSMesa tells the current context but not its memory, which making it current again needs.
thread_local OSMesaSurface* currentSurface = nullptr;

std::atomic<bool> mesaGone{false};

std::vector<int> getContextAttributes(const osg::GraphicsContext::Traits& traits)
{
    std::vector<int> attributes = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_STENCIL_BITS, 8};
    // OSG's default, version 1.0, means the highest compatibility profile.
    unsigned int major = 1, minor = 0;
    const bool versioned = traits.getContextVersion(major, minor) && major >= 3;
    const bool core = versioned && (traits.glContextProfileMask & 1);
    attributes.insert(attributes.end(),
                      {OSMESA_PROFILE, core ? OSMESA_CORE_PROFILE : OSMESA_COMPAT_PROFILE});
    if (versioned)
    {
        attributes.insert(attributes.end(),
                          {OSMESA_CONTEXT_MAJOR_VERSION, static_cast<int>(major),
                           OSMESA_CONTEXT_MINOR_VERSION, static_cast<int>(minor)});
    }
    attributes.push_back(0);
    return attributes;
}

} // namespace

OSMesaSurface* OSMesaSurface::getCurrent()
{
    return currentSurface;
}

void OSMesaSurface::forgetOSMesa()
{
    mesaGone = true;
}

OSMesaSurface::~OSMesaSurface()
{
    if (!_context || mesaGone)
    {
        return;
    }
    // The renderbuffers may live on in a context that shares them.
    if (_framebuffer)
    {
        OSMesaSurface* previous = currentSurface == this ? nullptr : currentSurface;
        if (makeCurrent())
        {
            glDeleteFramebuffers(1, &_framebuffer);
            glDeleteRenderbuffers(1, &_colour);
            glDeleteRenderbuffers(1, &_depthStencil);
        }
        release();
        if (previous)
        {
            previous->makeCurrent();
        }
    }
    if (currentSurface == this)
    {
        release();
    }
    OSMesaDestroyContext(_context);
}

bool OSMesaSurface::create(const osg::GraphicsContext::Traits& traits, const OSMesaSurface* shared)
{
    const auto attributes = getContextAttributes(traits);
    _context = OSMesaCreateContextAttribs(attributes.data(), shared ? shared->_context : nullptr);
    _samples = traits.samples;
    _width = traits.width;
    _height = traits.height;
    try
    {
        _pixels.resize(4 * static_cast<size_t>(_width) * _height);
    }
    catch (const std::bad_alloc&)
    {
        return false;
    }
    return _context && makeCurrent() && (!_samples || allocateMultisampled());
}

bool OSMesaSurface::makeCurrent(Surface* source)
{
    if (mesaGone)
    {
        return false;
    }
    if (currentSurface && currentSurface != this)
    {
        // Another context may read our memory next, and OSMesa fills it only here.
        currentSurface->finishFrame();
    }
    if (!bindMemory())
    {
        return false;
    }
    dropSource();
    if (_framebuffer)
    {
        glBindFramebuffer(GL_FRAMEBUFFER, _framebuffer);
    }
    if (source && source != this)
    {
        readFrom(*static_cast<OSMesaSurface*>(source));
    }
    return true;
}

bool OSMesaSurface::release()
{
    if (mesaGone)
    {
        return false;
    }
    if (currentSurface)
    {
        currentSurface->finishFrame();
    }
    currentSurface = nullptr;
    return OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
}

bool OSMesaSurface::bindMemory()
{
    if (!OSMesaMakeCurrent(_context, _pixels.data(), GL_UNSIGNED_BYTE, _width, _height))
    {
        return false;
    }
    currentSurface = this;
    return true;
}

bool OSMesaSurface::resize(int width, int height)
{
    std::vector<unsigned char> pixels;
    try
    {
        pixels.resize(4 * static_cast<size_t>(width) * height);
    }
    catch (const std::bad_alloc&)
    {
        return false;
    }
    _pixels.swap(pixels);
    _width = width;
    _height = height;
    return bindMemory() && (!_samples || allocateMultisampled());
}

bool OSMesaSurface::allocateMultisampled()
{
    if (!_framebuffer)
    {
        glGenFramebuffers(1, &_framebuffer);
        glGenRenderbuffers(1, &_colour);
        glGenRenderbuffers(1, &_depthStencil);
    }
    const GLsizei samples = static_cast<GLsizei>(_samples);
    glBindRenderbuffer(GL_RENDERBUFFER, _colour);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, _width, _height);
    GLint given = 0;
    glGetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &given);
    glBindRenderbuffer(GL_RENDERBUFFER, _depthStencil);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH24_STENCIL8, _width,
                                     _height);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, _framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, _colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              _depthStencil);
    _samples = given;
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void OSMesaSurface::finishFrame()
{
    if (_framebuffer)
    {
        // The scissor box clips a blit.
        const GLboolean scissor = glIsEnabled(GL_SCISSOR_TEST);
        glDisable(GL_SCISSOR_TEST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, _framebuffer);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, _width, _height, 0, 0, _width, _height, GL_COLOR_BUFFER_BIT,
                          GL_NEAREST);
        if (scissor)
        {
            glEnable(GL_SCISSOR_TEST);
        }
        // OSMesa writes to memory what is bound.
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glFinish();
        glBindFramebuffer(GL_FRAMEBUFFER, _framebuffer);
        return;
    }
    glFinish();
}

// OSMesa has no surface apart from its context, so what another one drew comes over its memory.
void OSMesaSurface::readFrom(OSMesaSurface& source)
{
    GLint texture = 0, alignment = 4, unpackBuffer = 0, rowLength = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    glGetIntegerv(GL_UNPACK_ROW_LENGTH, &rowLength);
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpackBuffer);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glGenTextures(1, &_sourceTexture);
    glBindTexture(GL_TEXTURE_2D, _sourceTexture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, source._width, source._height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, source._pixels.data());
    glGenFramebuffers(1, &_sourceFramebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, _sourceFramebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, _sourceTexture,
                           0);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, rowLength);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, unpackBuffer);
}

void OSMesaSurface::dropSource()
{
    if (_sourceFramebuffer)
    {
        // OSG selects GL_FRONT for the read, which a framebuffer object answers with this error.
        glGetError();
        glDeleteFramebuffers(1, &_sourceFramebuffer);
        glDeleteTextures(1, &_sourceTexture);
        _sourceFramebuffer = _sourceTexture = 0;
    }
}

} // namespace osgOSMesa
