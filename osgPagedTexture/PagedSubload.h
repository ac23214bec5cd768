// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pager.h>

#include <osg/Texture2D>

#include <memory>
#include <string>

namespace osgPagedTexture
{

/// What a model had as the image of a texture, for files that are written of it.
struct PagedOrigin
{
    std::string name; ///< As the model has it.
    std::string file;
    GLenum format = 0; ///< Of the pixels in the model; 0: they are the file's.
    GLint internalFormat = 0;
    osg::Image::WriteHint hint = osg::Image::EXTERNAL_FILE;
};

/// Shows what a pager has of a texture. The osg::Texture2D keeps all of its parameters; OSG sets
/// them on whatever GL texture this one names.
class PagedSubload : public osg::Texture2D::SubloadCallback
{
public:
    PagedSubload(std::shared_ptr<Pager> pager, unsigned int texture, PagedOrigin origin);

    unsigned int getTexture() const { return _texture; }
    const Pager* getPager() const { return _pager.get(); }
    const PagedOrigin& getOrigin() const { return _origin; }

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
    const PagedOrigin _origin;
};

} // namespace osgPagedTexture
