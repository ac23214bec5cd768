// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/Texture>

namespace osgMultiRender
{

/// A texture whose content comes from drawing or from uploads of its own, never from an osg::Image.
/// Each is one of its own: two are never equal.
class OSGMULTIRENDER_EXPORT ContentTexture : public osg::Texture
{
public:
    ContentTexture() = default;

    /// Without mip levels; `filter` both ways, clamped at the edges.
    ContentTexture(GLenum internalFormat, FilterMode filter);
    ContentTexture(const ContentTexture& other, const osg::CopyOp& copyop)
        : osg::Texture(other, copyop)
    {
    }

    int compare(const osg::StateAttribute& other) const override
    {
        return this < &other ? -1 : this == &other ? 0 : 1;
    }
    int getTextureDepth() const override { return 1; }
    void setImage(unsigned int, osg::Image*) override {}
    osg::Image* getImage(unsigned int) override { return nullptr; }
    const osg::Image* getImage(unsigned int) const override { return nullptr; }
    unsigned int getNumImages() const override { return 0; }

protected:
    ~ContentTexture() override = default;
    void computeInternalFormat() const override {}
    void allocateMipmap(osg::State&) const override {}

    /// Binds the texture of the state's context, or 0 for one without a size, which osg::State
    /// unbinds with. False if the context has none yet.
    bool bindExisting(osg::State& state) const;
};

/// Binds a texture to unit 0 for calls that change it; the state knows of it.
OSGMULTIRENDER_EXPORT void bindToChange(osg::State& state, const osg::Texture& texture);

/// bindToChange(), for uploads of tightly packed rows from memory.
OSGMULTIRENDER_EXPORT void bindToUpload(osg::State& state, const osg::Texture& texture);

} // namespace osgMultiRender
