// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osgMultiRender/ContentTexture.h>

namespace osgMultiRender
{

/// A texture to render to, of one or several layers and samples; OSG has no multisampled arrays.
///
/// Integer and float formats are read by texelFetch only.
class OSGMULTIRENDER_EXPORT TargetTexture : public ContentTexture
{
public:
    /// `layers` 0 makes a plain 2D texture, 1 and more an array. `samples` 1 is not multisampled.
    TargetTexture(GLenum internalFormat, int width, int height, int layers, int samples);
    TargetTexture(const TargetTexture& other,
                  const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_StateAttribute(osgMultiRender, TargetTexture, TEXTURE)

    GLenum getTextureTarget() const override;
    int getTextureWidth() const override { return _width; }
    int getTextureHeight() const override { return _height; }
    int getTextureDepth() const override { return _layers; }
    void apply(osg::State& state) const override;

    /// Attaches a layer to the framebuffer that is bound for drawing. The texture exists then.
    void attach(osg::State& state, GLenum attachment, int layer) const;

    std::size_t getBytes() const;

protected:
    ~TargetTexture() override = default;

private:
    TargetTexture() = default;

    int _width = 0, _height = 0, _layers = 0, _samples = 1;
};

} // namespace osgMultiRender
