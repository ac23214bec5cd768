// SPDX-License-Identifier: MIT
#pragma once

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
    osgMultiRender::DrawTarget like;

    bool operator==(const LabelLayout& other) const
    {
        return width == other.width && height == other.height &&
               like.samples == other.like.samples && like.flipped == other.like.flipped &&
               like.colorFormat == other.like.colorFormat &&
               like.depthFormat == other.like.depthFormat;
    }
};

/// What the first pass of one view writes, in one graphics context: colour, depth, identifier, and
/// place on the label with the pixel's footprint there. Window coordinates are those of the view.
class LabelTargets : public osg::Referenced
{
public:
    using Layout = LabelLayout;

    /// In the identifiers' target: no surface has been drawn.
    static constexpr unsigned int Nothing = 0xffffffffu;

    enum Unit
    {
        ColorUnit = 0,
        DepthUnit = 1,
        IdentifierUnit = 2,
        PlaceUnit = 3,
        FootprintUnit = 6
    };

    LabelTargets(unsigned int contextID, const LabelLayout& layout);

    const LabelLayout& getLayout() const { return _layout; }
    std::size_t getBytes() const;

    /// Binds the framebuffer for the first pass.
    void bind(osg::State& state);
    /// The textures at their units.
    const osg::StateSet* getStateSet() const { return _stateSet.get(); }
    /// Reads the identifier at a pixel of the window; Nothing outside. Leaves framebuffers bound.
    unsigned int readIdentifier(osg::State& state, int x, int y);

    void releaseGLObjects(osg::State* state) const;

protected:
    ~LabelTargets() override;

private:
    const LabelLayout _layout;
    osgMultiRender::Framebuffer _drawing, _single;
    osg::ref_ptr<osgMultiRender::TargetTexture> _color, _depth, _identifier, _place, _footprint;
    osg::ref_ptr<osgMultiRender::TargetTexture> _picked; ///< One sample; null before it is needed.
    osg::ref_ptr<osg::StateSet> _stateSet;
};

} // namespace osgLabels
