// SPDX-License-Identifier: MIT
#include <osgPagedTexture/GlFormat.h>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum Red = 0x1903, Green = 0x1904, Blue = 0x1905, Alpha = 0x1906, Rg = 0x8227;
constexpr GLenum R8 = 0x8229, Rg8 = 0x822B, Rgb8 = 0x8051, Rgba8 = 0x8058;
constexpr GLenum Dxt1 = 0x83F0, Dxt5 = 0x83F3, Rgtc1 = 0x8DBB, Rgtc2 = 0x8DBD, Bptc = 0x8E8C;

} // namespace

GlFormat glFormatOf(BlockFormat format)
{
    constexpr GLint one = 1;
    constexpr GLint r = Red, g = Green, b = Blue, a = Alpha;
    switch (format)
    {
    case BlockFormat::R8:
        return {R8, Red, {r, r, r, one}};
    case BlockFormat::RG8:
        return {Rg8, Rg, {r, g, one, one}};
    case BlockFormat::RGB8:
        return {Rgb8, GL_RGB, {r, g, b, a}};
    case BlockFormat::BC1:
        return {Dxt1, GL_RGB, {r, g, b, a}};
    case BlockFormat::BC3:
        return {Dxt5, GL_RGBA, {r, g, b, a}};
    case BlockFormat::BC4:
        return {Rgtc1, Red, {r, r, r, one}};
    case BlockFormat::BC5:
        return {Rgtc2, Rg, {r, g, one, one}};
    case BlockFormat::BC7:
        return {Bptc, GL_RGBA, {r, g, b, a}};
    case BlockFormat::RGBA8:
        break;
    }
    return {Rgba8, GL_RGBA, {r, g, b, a}};
}

} // namespace osgPagedTexture
