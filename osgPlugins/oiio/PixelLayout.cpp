// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/PixelLayout.h>

#include <osg/Texture>

#include <utility>

namespace osgKitsOiio
{

namespace
{

struct TypePair
{
    OIIO::TypeDesc::BASETYPE type;
    GLenum dataType;
};

constexpr TypePair Types[] = {
    {OIIO::TypeDesc::UINT8, GL_UNSIGNED_BYTE},   {OIIO::TypeDesc::INT8, GL_BYTE},
    {OIIO::TypeDesc::UINT16, GL_UNSIGNED_SHORT}, {OIIO::TypeDesc::INT16, GL_SHORT},
    {OIIO::TypeDesc::UINT32, GL_UNSIGNED_INT},   {OIIO::TypeDesc::INT32, GL_INT},
    {OIIO::TypeDesc::HALF, GL_HALF_FLOAT},       {OIIO::TypeDesc::FLOAT, GL_FLOAT},
    {OIIO::TypeDesc::DOUBLE, GL_DOUBLE}};

} // namespace

GLenum dataTypeOf(OIIO::TypeDesc type)
{
    for (const TypePair& pair : Types)
    {
        // OpenGL takes no pixels of 64 bits.
        if (pair.type == type.basetype && pair.dataType != GL_DOUBLE)
        {
            return pair.dataType;
        }
    }
    return GL_FLOAT;
}

OIIO::TypeDesc typeOf(GLenum dataType)
{
    for (const TypePair& pair : Types)
    {
        if (pair.dataType == dataType)
        {
            return pair.type;
        }
    }
    return OIIO::TypeUnknown;
}

GLenum pixelFormatOf(int channels)
{
    constexpr GLenum formats[] = {GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA};
    return formats[channels - 1];
}

GLint internalFormatOf(int channels, GLenum dataType)
{
    constexpr GLint half[] = {GL_LUMINANCE16F_ARB, GL_LUMINANCE_ALPHA16F_ARB, GL_RGB16F_ARB,
                              GL_RGBA16F_ARB};
    constexpr GLint single[] = {GL_LUMINANCE32F_ARB, GL_LUMINANCE_ALPHA32F_ARB, GL_RGB32F_ARB,
                                GL_RGBA32F_ARB};
    constexpr GLint normalized[] = {GL_LUMINANCE16, GL_LUMINANCE16_ALPHA16, GL_RGB16, GL_RGBA16};
    switch (dataType)
    {
    case GL_HALF_FLOAT:
        return half[channels - 1];
    case GL_FLOAT:
        return single[channels - 1];
    case GL_UNSIGNED_SHORT:
    case GL_SHORT:
    case GL_UNSIGNED_INT:
    case GL_INT:
        return normalized[channels - 1];
    default:
        return static_cast<GLint>(pixelFormatOf(channels));
    }
}

ChannelOrder channelOrderOf(GLenum pixelFormat)
{
    switch (pixelFormat)
    {
    case GL_LUMINANCE:
    case GL_ALPHA:
    case GL_INTENSITY:
    case GL_RED:
    case GL_DEPTH_COMPONENT:
        return {1, {0, 1, 2, 3}};
    case GL_LUMINANCE_ALPHA:
    case GL_RG:
        return {2, {0, 1, 2, 3}};
    case GL_RGB:
        return {3, {0, 1, 2, 3}};
    case GL_BGR:
        return {3, {2, 1, 0, 3}};
    case GL_RGBA:
        return {4, {0, 1, 2, 3}};
    case GL_BGRA:
        return {4, {2, 1, 0, 3}};
    default:
        return {0, {0, 1, 2, 3}};
    }
}

Placement placementOf(int storedWidth, int storedHeight, int pixelBytes, int orientation)
{
    const bool transposed = orientation >= 5 && orientation <= 8;
    // EXIF 2.3, tag 0x0112, with the seen picture's x to the right and y down: the stored columns
    // run along x, or y where transposed, and are mirrored where it says so; likewise the rows.
    const bool columnsMirrored =
        orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool rowsMirrored =
        orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;

    Placement placement;
    placement.width = transposed ? storedHeight : storedWidth;
    placement.height = transposed ? storedWidth : storedHeight;
    const OIIO::stride_t right = pixelBytes;
    const OIIO::stride_t down = -right * placement.width;
    placement.offset = -down * (placement.height - 1);
    placement.xStride = transposed ? down : right;
    placement.yStride = transposed ? right : down;
    if (columnsMirrored)
    {
        placement.offset += placement.xStride * (storedWidth - 1);
        placement.xStride = -placement.xStride;
    }
    if (rowsMirrored)
    {
        placement.offset += placement.yStride * (storedHeight - 1);
        placement.yStride = -placement.yStride;
    }
    return placement;
}

} // namespace osgKitsOiio
