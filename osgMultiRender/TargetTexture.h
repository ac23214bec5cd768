// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/Texture>

namespace osgMultiRender
{

/// A texture to render to, of one or several layers and samples; OSG has no multisampled arrays.
///
/// Integer and float formats are read by texelFetch only.
class OSGMULTIRENDER_EXPORT TargetTexture : public osg::Texture
{
public:
    /// `layers` 0 makes a plain 2D texture, 1 and more an array. `samples` 1 is not multisampled.
    TargetTexture(GLenum internalFormat, int width, int height, int layers, int samples);
    TargetTexture(const TargetTexture& other,
                  const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_StateAttribute(osgMultiRender, TargetTexture, TEXTURE)

    int compare(const osg::StateAttribute& other) const override;
    GLenum getTextureTarget() const override;
    int getTextureWidth() const override { return _width; }
    int getTextureHeight() const override { return _height; }
    int getTextureDepth() const override { return _layers; }
    void setImage(unsigned int, osg::Image*) override {}
    osg::Image* getImage(unsigned int) override { return nullptr; }
    const osg::Image* getImage(unsigned int) const override { return nullptr; }
    unsigned int getNumImages() const override { return 0; }
    void apply(osg::State& state) const override;

    /// Attaches a layer to the framebuffer that is bound for drawing. The texture exists then.
    void attach(osg::State& state, GLenum attachment, int layer) const;

    std::size_t getBytes() const;

protected:
    ~TargetTexture() override = default;
    void computeInternalFormat() const override {}
    void allocateMipmap(osg::State&) const override {}

private:
    TargetTexture() = default;

    int _width = 0, _height = 0, _layers = 0, _samples = 1;
};

} // namespace osgMultiRender
