// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphImages.h>
#include <osgLabels/GlyphTexture.h>

#include <osg/StateSet>
#include <osg/Uniform>

#include <memory>
#include <string>

namespace osgLabels
{

/// The texture and uniforms that coverage.glsl reads: the images of those glyphs that a scene's
/// texts use, and of no others.
class OSGLABELS_EXPORT GlyphAtlas : public osg::Referenced
{
public:
    /// `outlineWidth` in em, 0 for none: it takes twice the memory.
    explicit GlyphAtlas(std::shared_ptr<const GlyphSet> glyphs, float outlineWidth = 0.0f);

    /// Makes the images of glyphs that are new in the set; true where there were some. From one
    /// thread at a time; the texture may be drawn with meanwhile. A glyph takes some milliseconds.
    bool update();

    /// Sets the texture on the unit, and all uniforms of coverage.glsl.
    void apply(osg::StateSet& stateSet, unsigned int unit) const;

    /// #define lines that stand before coverage.glsl; the same for the atlas's life.
    std::string getDefines() const;

    /// Pixels an em below which letters fade out, gone at half of it; 0 and more, 2 at first.
    void setLegibleSize(float pixelsPerEm);
    float getLegibleSize() const;

    /// What letters too small to read leave: their mean ink as an even tone, as at first, or
    /// nothing.
    void setToneBelowLegible(bool enabled);
    bool getToneBelowLegible() const;

    const GlyphImages& getImages() const { return _images; }

    std::uint32_t getNumGlyphs() const { return _count; }

    /// Of all images, as they are on the GPU when it has them all.
    std::size_t getBytes() const;

protected:
    ~GlyphAtlas() override = default;

private:
    void updateLetters();

    const std::shared_ptr<const GlyphSet> _glyphs;
    const GlyphImages _images;
    const osg::ref_ptr<GlyphTexture> _texture;
    const osg::ref_ptr<osg::Uniform> _levels, _letters, _legible;
    std::uint32_t _count = 0;
    double _meanSum = 0.0;
};

} // namespace osgLabels
