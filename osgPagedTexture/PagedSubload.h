// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pager.h>

#include <osg/Texture2D>

#include <memory>

namespace osgPagedTexture
{

/// Shows what a pager has of a texture. The osg::Texture2D keeps all of its parameters; OSG sets
/// them on whatever GL texture this one names.
class PagedSubload : public osg::Texture2D::SubloadCallback
{
public:
    PagedSubload(std::shared_ptr<Pager> pager, unsigned int texture);

    unsigned int getTexture() const { return _texture; }
    const Pager* getPager() const { return _pager.get(); }

    bool textureObjectValid(const osg::Texture2D& texture, osg::State& state) const override;
    osg::ref_ptr<osg::Texture::TextureObject>
    generateTextureObject(const osg::Texture2D& texture, osg::State& state) const override;
    void load(const osg::Texture2D& texture, osg::State& state) const override;
    void subload(const osg::Texture2D& texture, osg::State& state) const override;

protected:
    ~PagedSubload() override;

private:
    const std::shared_ptr<Pager> _pager;
    const unsigned int _texture;
    const std::shared_ptr<const PagedState> _state;
};

} // namespace osgPagedTexture
