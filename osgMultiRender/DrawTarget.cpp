// SPDX-License-Identifier: MIT
#include <osgMultiRender/DrawTarget.h>

#include <osgMultiRender/Framebuffer.h>

#include <osg/FrameBufferObject>

#include <algorithm>
#include <cstring>

namespace osgMultiRender
{

namespace
{

constexpr GLenum rgbaFloatMode = 0x8820, drawBuffer1 = 0x8826;

GLint integerOf(GLenum name)
{
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

GLenum colorFormatOf(int redBits, bool isFloat)
{
    if (isFloat)
        return redBits > 16 ? GL_RGBA32F_ARB : GL_RGBA16F_ARB;
    return redBits > 10 ? GL_RGBA16 : redBits > 8 ? GL_RGB10_A2 : GL_RGBA8;
}

/// A texture that holds depths of so many bits, and gives those back that it was given: Mesa's
/// llvmpipe rounds twice where they have 24 bits, but hands floats through.
GLenum depthFormatOf(int bits)
{
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const bool keeps24 = !renderer || !std::strstr(renderer, "llvmpipe");
    if (bits > 0 && bits < 24)
        return GL_DEPTH_COMPONENT16;
    return bits > 24 || (bits && !keeps24) ? GL_DEPTH_COMPONENT32F : GL_DEPTH_COMPONENT24;
}

} // namespace

DrawTarget DrawTarget::current(const osg::State& state)
{
    DrawTarget target;
    target.samples = std::max(1, integerOf(GL_SAMPLES));
    target.flipped = target.samples > 1 && integerOf(GL_DRAW_FRAMEBUFFER_BINDING_EXT) == 0 &&
                     Framebuffer::canFlip(state);
    target.colorFormat = colorFormatOf(integerOf(GL_RED_BITS), integerOf(rgbaFloatMode) != 0);
    const GLint depthBits = integerOf(GL_DEPTH_BITS);
    target.hasDepth = depthBits > 0;
    target.depthFormat = depthFormatOf(depthBits);
    target.several = integerOf(drawBuffer1) != GL_NONE;
    return target;
}

} // namespace osgMultiRender
