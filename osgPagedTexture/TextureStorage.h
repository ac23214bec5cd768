// SPDX-License-Identifier: MIT
// The memory of a texture. Not installed.
#pragma once

#include <osgPagedTexture/BlockFormat.h>

#include <osg/GLExtensions>

#include <cstdint>

namespace osgPagedTexture
{

/// The levels of a picture from one on, down to 1 x 1.
struct TextureSize
{
    BlockFormat format = BlockFormat::RGBA8;
    int width = 0; ///< Of level 0.
    int height = 0;
    int level = 0; ///< The finest one that is there.

    std::uint64_t bytes() const { return chainBytes(format, width, height, level); }
    int levels() const { return levelCount(width, height) - level; }
};

/// Makes a texture of that size and binds it; what is in it is undefined. Returns its name, 0 where
/// GL has no memory for it.
GLuint makeStorage(const osg::GLExtensions& gl, const TextureSize& size);

} // namespace osgPagedTexture
