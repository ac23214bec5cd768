// SPDX-License-Identifier: MIT
#include "EglBackend.h"

#include <osg/GL>

#include <EGL/eglext.h>

namespace osgEgl
{

namespace
{

class EglSurface final : public osgHeadless::Surface
{
public:
    EglSurface(EGLDisplay display, EGLConfig config) : _display(display), _config(config) {}

    ~EglSurface() override
    {
        // EGL keeps a context and surface that are still current until they are released.
        if (_context && eglGetCurrentContext() == _context)
        {
            release();
        }
        if (_surface)
        {
            eglDestroySurface(_display, _surface);
        }
        if (_context)
        {
            eglDestroyContext(_display, _context);
        }
    }

    bool create(const osg::GraphicsContext::Traits& traits, const EglSurface* shared)
    {
        eglBindAPI(EGL_OPENGL_API);
        const auto attributes = getContextAttributes(traits);
        _context = eglCreateContext(_display, _config, shared ? shared->_context : EGL_NO_CONTEXT,
                                    attributes.data());
        _surface = _context ? createPbuffer(traits.width, traits.height) : EGL_NO_SURFACE;
        return _surface != EGL_NO_SURFACE;
    }

    bool makeCurrent(Surface* source) override
    {
        // The current API is per thread; a program may have bound OpenGL ES.
        eglBindAPI(EGL_OPENGL_API);
        const auto* read = source ? static_cast<EglSurface*>(source) : this;
        return eglMakeCurrent(_display, _surface, read->_surface, _context);
    }

    bool release() override
    {
        eglBindAPI(EGL_OPENGL_API);
        return eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    bool resize(int width, int height) override
    {
        const EGLSurface bigger = createPbuffer(width, height);
        if (!bigger || !eglMakeCurrent(_display, bigger, bigger, _context))
        {
            if (bigger)
            {
                eglDestroySurface(_display, bigger);
            }
            return false;
        }
        eglDestroySurface(_display, _surface);
        _surface = bigger;
        return true;
    }

    // A pbuffer has no front to swap to. Waiting keeps the program from queueing frames without
    // end.
    void finishFrame() override { glFinish(); }

    GLenum getColourBuffer() const override { return GL_BACK; }

    unsigned int getSamples() const override
    {
        EGLint samples = 0;
        eglGetConfigAttrib(_display, _config, EGL_SAMPLES, &samples);
        return samples;
    }

private:
    EGLSurface createPbuffer(int width, int height) const
    {
        const EGLint attributes[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
        const EGLSurface surface = eglCreatePbufferSurface(_display, _config, attributes);
        EGLint givenWidth = 0, givenHeight = 0;
        if (surface && eglQuerySurface(_display, surface, EGL_WIDTH, &givenWidth) &&
            eglQuerySurface(_display, surface, EGL_HEIGHT, &givenHeight) &&
            (givenWidth != width || givenHeight != height))
        {
            eglDestroySurface(_display, surface);
            return EGL_NO_SURFACE;
        }
        return surface;
    }

    // OSG's default, version 1.0, means the driver's highest compatibility profile.
    static std::vector<EGLint> getContextAttributes(const osg::GraphicsContext::Traits& traits)
    {
        std::vector<EGLint> attributes;
        unsigned int major = 1, minor = 0;
        if (traits.getContextVersion(major, minor) && major >= 3)
        {
            attributes = {EGL_CONTEXT_MAJOR_VERSION, static_cast<EGLint>(major),
                          EGL_CONTEXT_MINOR_VERSION, static_cast<EGLint>(minor)};
            if (traits.glContextProfileMask)
            {
                attributes.insert(attributes.end(),
                                  {EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   static_cast<EGLint>(traits.glContextProfileMask)});
            }
        }
        attributes.push_back(EGL_NONE);
        return attributes;
    }

    EGLDisplay _display;
    EGLConfig _config;
    EGLContext _context = EGL_NO_CONTEXT;
    EGLSurface _surface = EGL_NO_SURFACE;
};

} // namespace

const osgHeadless::Limits* EglBackend::getLimits(std::string& error)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_device.display)
    {
        const auto restore = rememberCurrent();
        const bool open = openDevice(getDeviceChoice(), _device, error);
        restore();
        return open ? &_device.limits : nullptr;
    }
    return &_device.limits;
}

std::unique_ptr<osgHeadless::Surface>
EglBackend::createSurface(const osg::GraphicsContext::Traits& traits, osgHeadless::Surface* shared,
                          std::string& error)
{
    const EGLConfig config = chooseConfig(_device.display, traits.samples);
    auto surface = std::make_unique<EglSurface>(_device.display, config);
    if (!surface->create(traits, static_cast<EglSurface*>(shared)))
    {
        error = "the driver makes no context of OpenGL " + traits.glContextVersion +
                " with a pbuffer of " + std::to_string(traits.width) + "x" +
                std::to_string(traits.height) + " and " + std::to_string(traits.samples) +
                " samples (" + getErrorName(eglGetError()) +
                "); ask for a smaller window, fewer samples or another version (--gl-version)";
        return nullptr;
    }
    return surface;
}

std::function<void()> EglBackend::rememberCurrent()
{
    eglBindAPI(EGL_OPENGL_API);
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLContext context = eglGetCurrentContext();
    const EGLSurface draw = eglGetCurrentSurface(EGL_DRAW);
    const EGLSurface read = eglGetCurrentSurface(EGL_READ);
    return [this, display, context, draw, read]
    {
        if (display)
        {
            eglMakeCurrent(display, draw, read, context);
        }
        else if (_device.display)
        {
            eglMakeCurrent(_device.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
    };
}

} // namespace osgEgl
