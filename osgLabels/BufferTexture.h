// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osgMultiRender/ContentTexture.h>

#include <cstddef>

namespace osgLabels
{

/// A buffer of unsigned integers that shaders read texel by texel, in one graphics context.
///
/// A texture buffer; where `isPaged` a 2D array of PageSize x PageSize texels a layer instead,
/// because GL promises no more than 65536 texels in a texture buffer. Shaders read either by
/// osgLabels_texel() of labelTable.glsl. All functions but those of osg::Texture need the context
/// to be current; they leave the texture bound to unit 0, and osg::State knows.
class OSGLABELS_EXPORT BufferTexture : public osgMultiRender::ContentTexture
{
public:
    static constexpr int PageSize = 1024;

    /// `wordsPerTexel`: 1, 2 or 4 32-bit words.
    BufferTexture(unsigned int contextID, unsigned int wordsPerTexel, bool isPaged);
    META_StateAttribute(osgLabels, BufferTexture, TEXTURE)

    /// Whether buffers have to be paged in a context to hold what osgLabels may put there.
    static bool needsPages(osg::State& state);

    /// Makes room for `bytes`. Returns whether the content is still there.
    bool resize(osg::State& state, std::size_t bytes);
    /// Writes whole texels within the size.
    void write(osg::State& state, std::size_t offset, const void* data, std::size_t bytes);

    unsigned int getWordsPerTexel() const { return _wordsPerTexel; }
    std::size_t getBytes() const { return _capacity; } ///< On the GPU.

    GLenum getTextureTarget() const override;
    int getTextureWidth() const override { return PageSize; }
    int getTextureHeight() const override { return PageSize; }
    void apply(osg::State& state) const override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~BufferTexture() override;

private:
    BufferTexture() = default;
    BufferTexture(const BufferTexture& other, const osg::CopyOp& copyop);

    void bind(osg::State& state) const;
    bool resizeBuffer(osg::State& state, std::size_t bytes);
    void resizePages(osg::State& state, std::size_t bytes);
    void writePages(const osg::State& state, std::size_t offset, const void* data,
                    std::size_t bytes) const;

    unsigned int _contextID = 0;
    unsigned int _wordsPerTexel = 0; ///< 0: what osg::State unbinds with.
    bool _isPaged = false;
    mutable GLuint _buffer = 0;
    mutable std::size_t _capacity = 0; ///< Bytes.
};

} // namespace osgLabels
