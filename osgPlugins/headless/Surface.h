// SPDX-License-Identifier: MIT
#pragma once

#include <osg/GraphicsContext>

#include <functional>
#include <memory>
#include <string>

namespace osgHeadless
{

/// A GL context with a default framebuffer that no window system shows.
///
/// The framebuffer has 8 bits a colour and alpha, 24 of depth and 8 of stencil. A surface is
/// current on at most one thread at a time.
class Surface
{
public:
    Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    virtual ~Surface() = default;

    /// Makes the context current on the calling thread; reads come from `source`, or from this
    /// surface when it is null. Returns false when the driver refuses.
    virtual bool makeCurrent(Surface* source = nullptr) = 0;

    /// Leaves the calling thread without a context.
    virtual bool release() = 0;

    /// Gives the framebuffer a new size in pixels. Call it where the context is current. On failure
    /// returns false and keeps the old framebuffer.
    virtual bool resize(int width, int height) = 0;

    /// The framebuffer object that stands for the default framebuffer; 0 where that is GL's own.
    virtual unsigned int getFramebuffer() const { return 0; }

    /// Completes the frame, so that framebuffer 0 holds its resolved colours. Call it where the
    /// context is current.
    virtual void finishFrame() = 0;

    /// The buffer that holds the finished frame's colours: GL_BACK or GL_FRONT.
    virtual GLenum getColourBuffer() const = 0;

    /// Samples per pixel; 0 without multisampling.
    virtual unsigned int getSamples() const = 0;
};

/// What the driver can give.
struct Limits
{
    int maxWidth = 0; ///< Of a viewport and of a surface, in pixels.
    int maxHeight = 0;
    unsigned int maxSamples = 0;
    std::string renderer; ///< GL_RENDERER.
};

/// Makes surfaces through one API (EGL, OSMesa). One object a process, used from any thread.
class Backend
{
public:
    /// The name of the windowing system, as Traits::windowingSystemPreference gives it.
    virtual const char* getName() const = 0;

    /// The plugin's name, which heads its messages: "osgdb_egl".
    virtual const char* getPluginName() const = 0;

    /// The driver's limits, or null with cause and remedy in `error` when there is no driver.
    virtual const Limits* getLimits(std::string& error) = 0;

    /// Makes a surface of the size, samples, version and profile of `traits`, which are within the
    /// limits; its GL objects are shared with `shared` unless that is null. Returns null and fills
    /// `error` when the driver refuses.
    virtual std::unique_ptr<Surface> createSurface(const osg::GraphicsContext::Traits& traits,
                                                   Surface* shared, std::string& error) = 0;

    /// Returns a function that makes current again what is current on the calling thread now.
    virtual std::function<void()> rememberCurrent() = 0;

    /// Called where a context was made current for the first time, after OSG looked up the
    /// extension functions of `state`.
    virtual void completeExtensions(osg::State& state);

protected:
    ~Backend() = default;
};

inline void Backend::completeExtensions(osg::State&) {}

} // namespace osgHeadless
