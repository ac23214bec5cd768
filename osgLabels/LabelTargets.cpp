// SPDX-License-Identifier: MIT
#include <osgLabels/LabelTargets.h>

#include <osg/FrameBufferObject>

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
    _identifier = make(GL_R32UI, IdentifierUnit);
    _place = make(GL_RG32F, PlaceUnit);
    _footprint = make(GL_RGBA16F_ARB, FootprintUnit);
}

LabelTargets::~LabelTargets() = default;

std::size_t LabelTargets::getBytes() const
{
    std::size_t bytes = 0;
    for (const TargetTexture* texture :
         {_color.get(), _depth.get(), _identifier.get(), _place.get(), _footprint.get()})
        bytes += texture->getBytes();
    return bytes;
}

void LabelTargets::bind(osg::State& state)
{
    _drawing.bind(state, 4);
    _depth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    GLenum attachment = GL_COLOR_ATTACHMENT0_EXT;
    for (TargetTexture* texture : {_color.get(), _identifier.get(), _place.get(), _footprint.get()})
        texture->attach(state, attachment++, 0);
}

unsigned int LabelTargets::readIdentifier(osg::State& state, int x, int y)
{
    if (x < 0 || y < 0 || x >= _layout.width || y >= _layout.height)
        return Nothing;
    const auto* gl = state.get<osg::GLExtensions>();
    bind(state);
    glReadBuffer(GL_COLOR_ATTACHMENT0_EXT + 1);
    if (_layout.like.samples > 1) // blitting integers takes one of the samples
    {
        if (!_picked)
            _picked = new TargetTexture(GL_R32UI, _layout.width, _layout.height, 0, 1);
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
    unsigned int identifier = Nothing;
    glReadPixels(x, y, 1, 1, GL_RED_INTEGER_EXT, GL_UNSIGNED_INT, &identifier);
    return identifier;
}

void LabelTargets::releaseGLObjects(osg::State* state) const
{
    _drawing.releaseGLObjects(state);
    _single.releaseGLObjects(state);
    for (const TargetTexture* texture : {_color.get(), _depth.get(), _identifier.get(),
                                         _place.get(), _footprint.get(), _picked.get()})
        if (texture)
            texture->releaseGLObjects(state);
}

} // namespace osgLabels
