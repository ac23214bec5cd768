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
};

} // namespace osgMultiRender
