// SPDX-License-Identifier: MIT
#include <osgMultiRender/TargetTexture.h>

#include <osg/FrameBufferObject>
#include <osg/GLExtensions>
#include <osg/State>

#include <algorithm>
#include <utility>

namespace osgMultiRender
{

namespace
{

constexpr GLenum texture2D = GL_TEXTURE_2D, texture2DArray = 0x8C1A, texture2DMultisample = 0x9100,
                 texture2DMultisampleArray = 0x9102;

/// Format and type of transfers must fit the kind of the internal format, though nothing is sent.
std::pair<GLenum, GLenum> transferOf(GLint internalFormat)
{
    switch (internalFormat)
    {
    case GL_DEPTH_COMPONENT16:
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32:
    case GL_DEPTH_COMPONENT32F:
        return {GL_DEPTH_COMPONENT, GL_FLOAT};
    case GL_DEPTH24_STENCIL8_EXT:
        return {GL_DEPTH_STENCIL_EXT, GL_UNSIGNED_INT_24_8_EXT};
    case GL_DEPTH32F_STENCIL8:
        return {GL_DEPTH_STENCIL_EXT, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
    case GL_R32UI:
        return {GL_RED_INTEGER_EXT, GL_UNSIGNED_INT};
    case GL_RG32UI:
        return {GL_RG_INTEGER, GL_UNSIGNED_INT};
    case GL_RGBA32UI_EXT:
        return {GL_RGBA_INTEGER_EXT, GL_UNSIGNED_INT};
    case GL_RG32F:
        return {GL_RG, GL_FLOAT};
    case GL_RGBA8:
    case GL_RGB10_A2:
    case GL_RGBA16:
    case GL_RGBA16F_ARB:
    case GL_RGBA32F_ARB:
        return {GL_RGBA, GL_FLOAT};
    default:
        return {GL_RED, GL_FLOAT};
    }
}

int bytesOf(GLint internalFormat)
{
    switch (internalFormat)
    {
    case GL_RG32F:
    case GL_RG32UI:
    case GL_RGBA16:
    case GL_RGBA16F_ARB:
    case GL_DEPTH32F_STENCIL8:
        return 8;
    case GL_RGBA32F_ARB:
    case GL_RGBA32UI_EXT:
        return 16;
    default:
        return 4;
    }
}

} // namespace

TargetTexture::TargetTexture(GLenum internalFormat, int width, int height, int layers, int samples)
    : ContentTexture(internalFormat, NEAREST), _width(width), _height(height), _layers(layers),
      _samples(samples)
{
}

TargetTexture::TargetTexture(const TargetTexture& other, const osg::CopyOp& copyop)
    : ContentTexture(other, copyop), _width(other._width), _height(other._height),
      _layers(other._layers), _samples(other._samples)
{
}

GLenum TargetTexture::getTextureTarget() const
{
    if (_samples > 1)
        return _layers ? texture2DMultisampleArray : texture2DMultisample;
    return _layers ? texture2DArray : texture2D;
}

void TargetTexture::apply(osg::State& state) const
{
    if (bindExisting(state))
        return;
    const unsigned int contextID = state.getContextID();
    const auto* gl = state.get<osg::GLExtensions>();
    const GLenum target = getTextureTarget();
    const int depth = std::max(1, _layers);
    // The number of samples stands in for that of mip levels: OSG's pool of orphaned textures does
    // not tell samples apart otherwise.
    generateAndAssignTextureObject(contextID, target, _samples, _internalFormat, _width, _height,
                                   depth, 0)
        ->bind();
    if (_samples > 1 && _layers)
        gl->glTexImage3DMultisample(target, _samples, _internalFormat, _width, _height, depth,
                                    GL_TRUE);
    else if (_samples > 1)
        gl->glTexImage2DMultisample(target, _samples, _internalFormat, _width, _height, GL_TRUE);
    else
    {
        const auto [format, type] = transferOf(_internalFormat);
        applyTexParameters(target, state);
        if (_layers)
            gl->glTexImage3D(target, 0, _internalFormat, _width, _height, depth, 0, format, type,
                             nullptr);
        else
            glTexImage2D(target, 0, _internalFormat, _width, _height, 0, format, type, nullptr);
    }
    getTextureObject(contextID)->setAllocated(true);
}

void TargetTexture::attach(osg::State& state, GLenum attachment, int layer) const
{
    const auto* gl = state.get<osg::GLExtensions>();
    if (!getTextureObject(state.getContextID()))
        bindToChange(state, *this);
    const GLuint id = getTextureObject(state.getContextID())->id();
    if (_layers)
        gl->glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER_EXT, attachment, id, 0, layer);
    else
        gl->glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER_EXT, attachment, getTextureTarget(), id, 0);
}

std::size_t TargetTexture::getBytes() const
{
    return std::size_t(_width) * _height * std::max(1, _layers) * _samples *
           bytesOf(_internalFormat);
}

} // namespace osgMultiRender
