// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Camera>
#include <osg/Image>

#include <condition_variable>
#include <mutex>
#include <string>

namespace osgrender
{

/// What the context says that it is.
struct Renderer
{
    std::string vendor, name, version, glsl;
};

/// Reads the finished frame back, in the thread that draws it.
///
/// Takes the last place in a camera's drawing: its final draw callback. Reads the default
/// framebuffer, its samples averaged, or, with float pixels, the camera's own render target, which
/// keeps values above 1.
class Capture : public osg::Camera::DrawCallback
{
public:
    explicit Capture(bool floatPixels);

    /// Makes the camera call this, and draw into float pixels where they are asked for.
    void install(osg::Camera& camera, int samples);

    /// Call before a frame: whether its picture is wanted.
    void beginFrame(bool wanted);

    /// Waits until the frame is drawn. False when that takes longer than `seconds`.
    bool waitForFrame(double seconds);

    /// The last wanted picture, RGB of bytes or floats, the bottom row first. Null when none was
    /// drawn.
    osg::ref_ptr<osg::Image> getPicture() const;

    const Renderer& getRenderer() const { return _renderer; }

    /// OpenGL errors that were pending at the ends of frames, since construction.
    unsigned int getGlErrors() const { return _glErrors; }

    /// Bytes of all texture objects that OSG holds in the context, after the last frame.
    double getTextureBytes() const { return _textureBytes; }

    void operator()(osg::RenderInfo& renderInfo) const override;

protected:
    ~Capture() override = default;

private:
    void readDefaultFramebuffer(osg::State& state) const;
    void countErrors() const;

    bool _floatPixels;
    osg::ref_ptr<osg::Image> _target; // what OSG reads the float pixels into

    // OSG calls a const operator from the draw thread; the mutex guards all of it.
    mutable std::mutex _mutex;
    mutable std::condition_variable _drawn;
    mutable bool _wanted = false;
    mutable bool _finished = false;
    mutable osg::ref_ptr<osg::Image> _picture;
    mutable Renderer _renderer;
    mutable unsigned int _glErrors = 0;
    mutable double _textureBytes = 0.0;
};

} // namespace osgrender
