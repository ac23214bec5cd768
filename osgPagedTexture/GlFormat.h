// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockFormat.h>

#include <osg/GL>

namespace osgPagedTexture
{

/// What OpenGL calls a format.
struct GlFormat
{
    GLenum internal;  ///< Sized.
    GLenum layout;    ///< GL_RED to GL_RGBA; of plain formats, as they are uploaded.
    GLint swizzle[4]; ///< So that shaders and texture environments see grey as grey.
};

GlFormat glFormatOf(BlockFormat format);

} // namespace osgPagedTexture
