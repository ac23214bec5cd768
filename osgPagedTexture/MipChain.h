// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockFormat.h>

#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// The levels of a texture from one level on, ready for OpenGL. A value without GL or OSG.
struct MipChain
{
    BlockFormat format = BlockFormat::RGBA8;
    int width = 0;      ///< Texels of level 0, which the chain need not hold.
    int height = 0;     ///< Texels of level 0.
    int firstLevel = 0; ///< The finest level that it holds.
    std::vector<std::vector<std::uint8_t>>
        levels; ///< levels[i] is level firstLevel + i; the last is 1x1.

    std::uint64_t bytes() const { return chainBytes(format, width, height, firstLevel); }
};

} // namespace osgPagedTexture
