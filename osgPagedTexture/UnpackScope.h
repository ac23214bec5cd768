// SPDX-License-Identifier: MIT
// How GL reads pixels. Not installed.
#pragma once

#include <osg/GLExtensions>
#include <osg/State>
#include <osg/StateAttribute>

namespace osgPagedTexture
{

/// Until its end GL reads pixels as they lie in memory; then the pixel store is as before, and
/// `state` knows that the active unit's texture has changed.
class UnpackScope
{
public:
    static constexpr GLenum Buffer = 0x88EC;

    explicit UnpackScope(osg::State& state) : _state(state)
    {
        _state.unbindPixelBufferObject();
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        for (const GLenum name : {GLenum(GL_UNPACK_SWAP_BYTES), GLenum(GL_UNPACK_LSB_FIRST),
                                  GLenum(GL_UNPACK_ROW_LENGTH), GLenum(GL_UNPACK_SKIP_ROWS),
                                  GLenum(GL_UNPACK_SKIP_PIXELS)})
            glPixelStorei(name, 0);
    }
    ~UnpackScope()
    {
        _state.get<osg::GLExtensions>()->glBindBuffer(Buffer, 0);
        glPopClientAttrib();
        _state.haveAppliedTextureAttribute(_state.getActiveTextureUnit(),
                                           osg::StateAttribute::TEXTURE);
    }
    UnpackScope(const UnpackScope&) = delete;
    UnpackScope& operator=(const UnpackScope&) = delete;

private:
    osg::State& _state;
};

} // namespace osgPagedTexture
