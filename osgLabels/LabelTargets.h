// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>
#include <osgMultiRender/DrawTarget.h>
#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/StateSet>

namespace osgLabels
{

/// What the targets of one view look like.
struct LabelLayout
{
    int width = 0, height = 0; ///< Pixels, to the upper right corner of the viewport.
    bool textured = false;     ///< Surfaces may have labels by texture coordinates.
    osgMultiRender::DrawTarget like;

    bool operator==(const LabelLayout& other) const
    {
        return width == other.width && height == other.height && textured == other.textured &&
               like.samples == other.like.samples && like.flipped == other.like.flipped &&
               like.colorFormat == other.like.colorFormat &&
               like.depthFormat == other.like.depthFormat;
    }
};

/// What the first pass of one view writes, in one graphics context: colour, depth, and what
/// target.frag says of the surface. Window coordinates are those of the view.
class LabelTargets : public osg::Referenced
{
public:
    using Layout = LabelLayout;

    /// For the index of a record: no surface has been drawn.
    static constexpr unsigned int Nothing = 0xffffffffu;

    enum Unit
    {
        ColorUnit = 0,
        DepthUnit = 1,
        SurfaceUnit = 2,
        TexCoordUnit = 3,
        ChangeUnit = 9
    };

    LabelTargets(unsigned int contextID, const LabelLayout& layout);

    const LabelLayout& getLayout() const { return _layout; }
    std::size_t getBytes() const;

    /// Binds the framebuffer for the first pass.
    void bind(osg::State& state);
    /// Uploads osgLabels_frames of composite.frag.
    void setFrames(osg::State& state, const void* data, std::size_t bytes);
    /// The textures at their units.
    const osg::StateSet* getStateSet() const { return _stateSet.get(); }
    /// Reads the index of the record at a pixel of the window; Nothing outside. Leaves framebuffers
    /// bound.
    unsigned int readIndex(osg::State& state, int x, int y);

    void releaseGLObjects(osg::State* state) const;

protected:
    ~LabelTargets() override;

private:
    const LabelLayout _layout;
    osgMultiRender::Framebuffer _drawing, _single;
    osg::ref_ptr<osgMultiRender::TargetTexture> _color, _depth, _surface;
    osg::ref_ptr<osgMultiRender::TargetTexture> _texCoord, _change; ///< Null if not textured.
    osg::ref_ptr<osgMultiRender::TargetTexture> _picked; ///< One sample; null before it is needed.
    osg::ref_ptr<BufferTexture> _frames;
    osg::ref_ptr<osg::StateSet> _stateSet;
};

} // namespace osgLabels
