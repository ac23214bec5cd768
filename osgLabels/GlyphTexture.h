// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/buffered_value>
#include <osgMultiRender/ContentTexture.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace osgLabels
{

/// An array texture to which images are added while it is drawn with.
///
/// Image i is in layer i & (layers - 1); what exceeds the layers that GL allows lies beside in the
/// same layers. Each context uploads the new images only, or all when the texture had to grow to
/// twice its size.
class OSGLABELS_EXPORT GlyphTexture : public osgMultiRender::ContentTexture
{
public:
    GlyphTexture() = default;

    /// `format` GL_RED or GL_RGBA, 8 bits a channel.
    GlyphTexture(GLenum format, int imageWidth, int imageHeight);
    GlyphTexture(const GlyphTexture& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_StateAttribute(osgLabels, GlyphTexture, TEXTURE)

    /// Adds an image, row by row from the bottom. From any thread.
    void add(std::vector<std::uint8_t> pixels);

    std::size_t getNumGlyphImages() const;

    /// Of the images, which are kept here for other contexts and for growing.
    std::size_t getBytes() const;

    GLenum getTextureTarget() const override;
    int getTextureWidth() const override { return _imageWidth; }
    int getTextureHeight() const override { return _imageHeight; }
    void apply(osg::State& state) const override;

protected:
    ~GlyphTexture() override = default;

private:
    /// What one context holds.
    struct Uploaded
    {
        std::size_t images = 0;
        int layers = 0, columns = 0;
    };
    struct Images;

    bool allocate(osg::State& state, std::size_t count, Uploaded& uploaded) const;
    void upload(osg::State& state, std::size_t image, const Uploaded& uploaded) const;

    GLenum _format = 0;
    int _imageWidth = 0, _imageHeight = 0;
    std::shared_ptr<Images> _images; ///< Copies of the texture show the same.
    mutable osg::buffered_object<Uploaded> _uploaded;
};

} // namespace osgLabels
