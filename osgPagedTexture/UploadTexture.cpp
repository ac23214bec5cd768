// SPDX-License-Identifier: MIT
#include <osgPagedTexture/UploadTexture.h>

#include <osgPagedTexture/GlFormat.h>

#include <osg/BufferObject>
#include <osg/GLExtensions>
#include <osg/State>

namespace osgPagedTexture
{

UploadTexture::UploadTexture(const Format& format, int width, int height)
    : ContentTexture(format.internal, format.isLinear ? LINEAR : NEAREST), _format(format),
      _width(width), _height(height)
{
}

UploadTexture::UploadTexture(const UploadTexture& other, const osg::CopyOp& copyop)
    : ContentTexture(other, copyop), _format(other._format), _width(other._width),
      _height(other._height)
{
}

UploadTexture::Format UploadTexture::formatOf(BlockFormat format)
{
    const GlFormat gl = glFormatOf(format);
    return {gl.internal, gl.layout, GL_UNSIGNED_BYTE, format != BlockFormat::RGBA8, true};
}

void UploadTexture::apply(osg::State& state) const
{
    if (bindExisting(state))
        return;
    const unsigned int contextID = state.getContextID();
    generateAndAssignTextureObject(contextID, GL_TEXTURE_2D, 1, GLenum(_internalFormat), _width,
                                   _height, 1, 0)
        ->bind();
    applyTexParameters(GL_TEXTURE_2D, state);
    state.unbindPixelBufferObject();
    glTexImage2D(GL_TEXTURE_2D, 0, _internalFormat, _width, _height, 0, _format.layout,
                 _format.type, nullptr);
    getTextureObject(contextID)->setAllocated(true);
}

void UploadTexture::upload(osg::State& state, int x, int y, int width, int height,
                           const void* texels, std::size_t bytes) const
{
    osgMultiRender::bindToUpload(state, *this);
    if (_format.isCompressed)
        state.get<osg::GLExtensions>()->glCompressedTexSubImage2D(
            GL_TEXTURE_2D, 0, x, y, width, height, _format.internal, GLsizei(bytes), texels);
    else
        glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, _format.layout, _format.type,
                        texels);
}

} // namespace osgPagedTexture
