// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedSubload.h>

#include <osgPagedTexture/GlFormat.h>

#include <osg/FrameStamp>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum Red = 0x1903, SwizzleRgba = 0x8E46;

/// What the model's own swizzle makes of what the format's gives.
GLint chained(GLint own, const GLint (&format)[4])
{
    const int channel = own - GLint(Red);
    return channel >= 0 && channel < 4 ? format[channel] : own;
}

} // namespace

PagedSubload::PagedSubload(std::shared_ptr<Pager> pager, unsigned int texture, PagedOrigin origin)
    : _pager(std::move(pager)), _texture(texture), _state(_pager->getState(texture)),
      _origin(std::move(origin))
{
}

PagedSubload::~PagedSubload()
{
    _pager->remove(_texture);
}

bool PagedSubload::textureObjectValid(const osg::Texture2D& texture, osg::State& state) const
{
    if (_pager->waits())
        _pager->waitForAll(state,
                           state.getFrameStamp() ? state.getFrameStamp()->getFrameNumber() : 0);
    const osg::Texture::TextureObject* object = texture.getTextureObject(state.getContextID());
    return object && object->id() == _pager->getShown(_texture, *_state, state).name;
}

osg::ref_ptr<osg::Texture::TextureObject>
PagedSubload::generateTextureObject(const osg::Texture2D& texture, osg::State& state) const
{
    if (_pager->waits())
        _pager->waitForAll(state,
                           state.getFrameStamp() ? state.getFrameStamp()->getFrameNumber() : 0);
    const Pager::Shown shown = _pager->getShown(_texture, *_state, state);
    return new osg::Texture::TextureObject(const_cast<osg::Texture2D*>(&texture), shown.name,
                                           GL_TEXTURE_2D);
}

void PagedSubload::load(const osg::Texture2D& texture, osg::State& state) const
{
    subload(texture, state);
}

void PagedSubload::subload(const osg::Texture2D& texture, osg::State& state) const
{
    const GlFormat format = glFormatOf(_pager->getShown(_texture, *_state, state).format);
    const osg::Vec4i own = texture.getSwizzle();
    GLint swizzle[4];
    bool isPlain = true;
    for (int i = 0; i < 4; ++i)
    {
        swizzle[i] = chained(own[i], format.swizzle);
        isPlain = isPlain && format.swizzle[i] == GLint(Red) + i;
    }
    if (!isPlain)
        glTexParameteriv(GL_TEXTURE_2D, SwizzleRgba, swizzle);
}

} // namespace osgPagedTexture
