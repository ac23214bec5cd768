// SPDX-License-Identifier: MIT
#include <osgMultiRender/ContentTexture.h>

#include <osg/State>

namespace osgMultiRender
{

ContentTexture::ContentTexture(GLenum internalFormat, FilterMode filter)
{
    setInternalFormat(static_cast<GLint>(internalFormat));
    setFilter(MIN_FILTER, filter);
    setFilter(MAG_FILTER, filter);
    setWrap(WRAP_S, CLAMP_TO_EDGE);
    setWrap(WRAP_T, CLAMP_TO_EDGE);
    setUseHardwareMipMapGeneration(false);
}

bool ContentTexture::bindExisting(osg::State& state) const
{
    if (TextureObject* object = getTextureObject(state.getContextID()))
    {
        object->bind();
        return true;
    }
    if (getTextureWidth())
        return false;
    glBindTexture(getTextureTarget(), 0);
    return true;
}

void bindToChange(osg::State& state, const osg::Texture& texture)
{
    state.setActiveTextureUnit(0);
    texture.apply(state);
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXTURE);
}

void bindToUpload(osg::State& state, const osg::Texture& texture)
{
    bindToChange(state, texture);
    state.unbindPixelBufferObject();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

} // namespace osgMultiRender
