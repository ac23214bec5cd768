// SPDX-License-Identifier: MIT
#pragma once

#include <osgPlugins/headless/Surface.h>

#include <GL/osmesa.h>

#include <vector>

namespace osgOSMesa
{

/// An OSMesa context that renders to memory.
///
/// OSMesa has no multisampling: with samples a framebuffer object stands for the default
/// framebuffer and finishFrame() resolves it.
class OSMesaSurface final : public osgHeadless::Surface
{
public:
    ~OSMesaSurface() override;

    /// The surface that is current on the calling thread, or null.
    static OSMesaSurface* getCurrent();

    /// From now on surfaces call OSMesa no more and are never current. For the time at exit when
    /// OSMesa has cleaned up but windows of static objects still close.
    static void forgetOSMesa();

    /// Makes the context. Returns false when OSMesa refuses.
    bool create(const osg::GraphicsContext::Traits& traits, const OSMesaSurface* shared);

    bool makeCurrent(Surface* source = nullptr) override;
    bool release() override;
    bool resize(int width, int height) override;
    unsigned int getFramebuffer() const override { return _framebuffer; }
    void finishFrame() override;
    GLenum getColourBuffer() const override { return GL_FRONT; }
    unsigned int getSamples() const override { return _samples; }

private:
    bool bindMemory();
    bool allocateMultisampled();
    void readFrom(OSMesaSurface& source);
    void dropSource();

    OSMesaContext _context = nullptr;
    std::vector<unsigned char> _pixels; // framebuffer 0, RGBA
    int _width = 0, _height = 0;
    unsigned int _samples = 0;
    unsigned int _framebuffer = 0, _colour = 0, _depthStencil = 0;
    unsigned int _sourceFramebuffer = 0, _sourceTexture = 0; // while reads come from elsewhere
};

} // namespace osgOSMesa
