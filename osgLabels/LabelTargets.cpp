// SPDX-License-Identifier: MIT
#include <osgLabels/LabelTargets.h>

#include <osgLabels/LabelUnits.h>

#include <osg/FrameBufferObject>

#include <algorithm>

namespace osgLabels
{

using osgMultiRender::TargetTexture;

LabelTargets::LabelTargets(unsigned int contextID, const LabelLayout& layout)
    : osg::Referenced(true), _layout(layout), _drawing(contextID, layout.like.flipped),
      _single(contextID, layout.like.flipped), _stateSet(new osg::StateSet)
{
    const auto make = [&](GLenum format, int unit)
    {
        osg::ref_ptr<TargetTexture> texture =
            new TargetTexture(format, layout.width, layout.height, 0, layout.like.samples);
        _stateSet->setTextureAttribute(unit, texture, osg::StateAttribute::OVERRIDE);
        return texture;
    };
    _color = make(layout.like.colorFormat, ColorUnit);
    _depth = make(layout.like.depthFormat, DepthUnit);
    _surface = make(GL_RGBA32UI_EXT, SurfaceUnit);
    if (!layout.textured)
        return;
    _texCoord = make(GL_RG32F, TexCoordUnit);
    _change = make(GL_RGBA16F_ARB, ChangeUnit);
}

LabelTargets::~LabelTargets() = default;

std::size_t LabelTargets::getBytes() const
{
    std::size_t bytes = 0;
    for (const TargetTexture* texture :
         {_color.get(), _depth.get(), _surface.get(), _texCoord.get(), _change.get()})
        bytes += !texture ? 0 : texture->getBytes();
    return bytes;
}

void LabelTargets::bind(osg::State& state)
{
    _drawing.bind(state, _layout.textured ? 4 : 2);
    _depth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    GLenum attachment = GL_COLOR_ATTACHMENT0_EXT;
    for (TargetTexture* texture : {_color.get(), _surface.get(), _texCoord.get(), _change.get()})
        if (texture)
            texture->attach(state, attachment++, 0);
}

void LabelTargets::setFrames(osg::State& state, const void* data, std::size_t bytes)
{
    if (!_frames)
    {
        _frames = new BufferTexture(state.getContextID(), 4, BufferTexture::needsPages(state));
        _stateSet->setTextureAttribute(FramesUnit, _frames, osg::StateAttribute::OVERRIDE);
    }
    _frames->resize(state, std::max<std::size_t>(bytes, 16));
    if (bytes)
        _frames->write(state, 0, data, bytes);
}

unsigned int LabelTargets::readIndex(osg::State& state, int x, int y)
{
    if (x < 0 || y < 0 || x >= _layout.width || y >= _layout.height)
        return Nothing;
    const auto* gl = state.get<osg::GLExtensions>();
    bind(state);
    glReadBuffer(GL_COLOR_ATTACHMENT0_EXT + 1);
    if (_layout.like.samples > 1) // blitting integers takes one of the samples
    {
        if (!_picked)
            _picked = new TargetTexture(GL_RGBA32UI_EXT, _layout.width, _layout.height, 0, 1);
        _single.bind(state, 1);
        _picked->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
        GLint single = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING_EXT, &single);
        bind(state);
        glReadBuffer(GL_COLOR_ATTACHMENT0_EXT + 1);
        gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, GLuint(single));
        gl->glBlitFramebuffer(x, y, x + 1, y + 1, x, y, x + 1, y + 1, GL_COLOR_BUFFER_BIT,
                              GL_NEAREST);
        gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, GLuint(single));
        glReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
    }
    GLuint surface[4] = {Nothing, 0, 0, 0};
    glReadPixels(x, y, 1, 1, GL_RGBA_INTEGER_EXT, GL_UNSIGNED_INT, surface);
    return surface[0];
}

void LabelTargets::releaseGLObjects(osg::State* state) const
{
    _drawing.releaseGLObjects(state);
    _single.releaseGLObjects(state);
    for (const TargetTexture* texture : {_color.get(), _depth.get(), _surface.get(),
                                         _texCoord.get(), _change.get(), _picked.get()})
        if (texture)
            texture->releaseGLObjects(state);
    if (_frames)
        _frames->releaseGLObjects(state);
}

} // namespace osgLabels
