// SPDX-License-Identifier: MIT
#pragma once

#include <osg/GL>
#include <osg/GLExtensions>

namespace osgLabels
{

/// While it lives OpenGL reads images as they lie in memory, row after row, whatever others have
/// set. Requires the context to be current.
class UnpackState
{
public:
    explicit UnpackState(const osg::GLExtensions& gl)
    {
        constexpr GLenum skipImages = 0x806D, imageHeight = 0x806E, unpackBuffer = 0x88EC;
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        for (const GLenum name : {GLenum(GL_UNPACK_SWAP_BYTES), GLenum(GL_UNPACK_LSB_FIRST),
                                  GLenum(GL_UNPACK_ROW_LENGTH), GLenum(GL_UNPACK_SKIP_ROWS),
                                  GLenum(GL_UNPACK_SKIP_PIXELS), skipImages, imageHeight})
            glPixelStorei(name, 0);
        gl.glBindBuffer(unpackBuffer, 0);
    }
    ~UnpackState() { glPopClientAttrib(); }
    UnpackState(const UnpackState&) = delete;
    UnpackState& operator=(const UnpackState&) = delete;
};

} // namespace osgLabels
