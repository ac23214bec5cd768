// SPDX-License-Identifier: MIT
// A texture that is filled piece by piece. Not installed.
#pragma once

#include <osgPagedTexture/BlockFormat.h>

#include <osgMultiRender/ContentTexture.h>

#include <cstddef>

namespace osgPagedTexture
{

/// One level of texels of which parts are uploaded; for one graphics context.
class UploadTexture : public osgMultiRender::ContentTexture
{
public:
    struct Format
    {
        GLenum internal = 0;
        GLenum layout = 0;
        GLenum type = GL_UNSIGNED_BYTE;
        bool isCompressed = false; ///< Uploads are whole blocks of 4 x 4 texels.
        bool isLinear = false;     ///< Filtered; else read by texelFetch.
    };
    UploadTexture(const Format& format, int width, int height);
    UploadTexture(const UploadTexture& other,
                  const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_StateAttribute(osgPagedTexture, UploadTexture, TEXTURE)

    /// Of the pages of a physical texture.
    static Format formatOf(BlockFormat format);

    GLenum getTextureTarget() const override { return GL_TEXTURE_2D; }
    int getTextureWidth() const override { return _width; }
    int getTextureHeight() const override { return _height; }
    void apply(osg::State& state) const override;

    /// Replaces texels; rows are tightly packed. Uses unit 0.
    void upload(osg::State& state, int x, int y, int width, int height, const void* texels,
                std::size_t bytes) const;

protected:
    ~UploadTexture() override = default;

private:
    UploadTexture() = default;

    Format _format;
    int _width = 0, _height = 0;
};

} // namespace osgPagedTexture
