// SPDX-License-Identifier: MIT
#pragma once

#include <OpenImageIO/imageio.h>

#include <osg/Image>

#include <array>

namespace osgKitsOiio
{

/// The OpenGL type of pixels that OpenImageIO calls type; 64-bit types have none and give GL_FLOAT.
GLenum dataTypeOf(OIIO::TypeDesc type);

/// OpenImageIO's name of an OpenGL type; TypeUnknown for packed types as GL_UNSIGNED_SHORT_5_6_5.
OIIO::TypeDesc typeOf(GLenum dataType);

/// The OpenGL format of 1 to 4 channels: luminance, luminance with alpha, RGB, RGBA.
GLenum pixelFormatOf(int channels);

/// The internal format that keeps what the pixels hold. As OSG's own plugins do, 8-bit pictures
/// leave the choice to the driver; an unsized format would round and clamp the others.
GLint internalFormatOf(int channels, GLenum dataType);

/// Where each channel lies in a pixel of an OpenGL format.
struct ChannelOrder
{
    int count = 0; ///< 1 to 4; 0: not a format that holds a colour.
    std::array<int, 4> index = {0, 1, 2,
                                3}; ///< Of luminance (and alpha), or red, green, blue (, alpha).
};
ChannelOrder channelOrderOf(GLenum pixelFormat);

/// How the stored pixels of a file lie in an osg::Image, whose first row is the bottom one:
/// pixel (i, j), j counted from the file's first row, is at offset + i * xStride + j * yStride
/// bytes.
struct Placement
{
    int width = 0;  ///< Of the picture as it is to be seen, in pixels.
    int height = 0; ///< Likewise.
    OIIO::stride_t offset = 0;
    OIIO::stride_t xStride = 0;
    OIIO::stride_t yStride = 0;
};

/// The placement of a stored picture of storedWidth x storedHeight pixels of pixelBytes bytes under
/// an EXIF orientation; anything but 2 to 8 counts as 1, upright.
Placement placementOf(int storedWidth, int storedHeight, int pixelBytes, int orientation);

} // namespace osgKitsOiio
