// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/StateSet>

#include <optional>
#include <string>

namespace osgShadowVolume
{

using osgMultiRender::Framebuffer;
using osgMultiRender::FramebufferVisit;
using osgMultiRender::TargetTexture;

/// What the targets of one view look like.
struct TargetLayout
{
    int width = 0, height = 0; ///< Pixels, to the upper right corner of the viewport.
    int samples = 1;
    int words = 1;        ///< 32 lights each.
    int layers = 0;       ///< Transparent layers.
    bool flipped = false; ///< Rows count from the top.

    bool operator==(const TargetLayout& other) const
    {
        return width == other.width && height == other.height && samples == other.samples &&
               words == other.words && layers == other.layers && flipped == other.flipped;
    }
};

/// The buffers that visibility bits are made in, for one view in one graphics context.
///
/// Window coordinates are those of the view, so that scissors and clip planes mean the same.
class ShadowTargets : public osg::Referenced
{
public:
    using Layout = TargetLayout;

    static constexpr int MaskUnit = 13;        ///< Texture unit of osgsv_mask.
    static constexpr int LayersUnit = 12;      ///< Texture unit of osgsv_layers.
    static constexpr int DepthUnit = 11;       ///< Read while layers are peeled.
    static constexpr int OpaqueDepthUnit = 10; ///< Likewise.

    ShadowTargets(unsigned int contextID, const TargetLayout& layout);

    const TargetLayout& getLayout() const { return _layout; }
    /// For the shaders: the height where rows count from the top, else 0.
    int getFlippedHeight() const { return _layout.flipped ? _layout.height : 0; }
    std::size_t getBytes() const;

    /// Empty, or why OpenGL can't draw into them. Asks it the first time only, and then leaves
    /// another framebuffer bound.
    const std::string& whyIncomplete(osg::State& state);

    /// Binds the framebuffer for the opaque surfaces' depths; no colour.
    void bindDepth(osg::State& state);
    /// ... for the depths of a transparent layer, which also go to the array of layers.
    void bindLayer(osg::State& state, int layer);
    /// ... for counts against the depths of a layer; -1 is the opaque surfaces.
    void bindCounter(osg::State& state, int layer);
    /// ... for the bits of 32 lights.
    void bindMask(osg::State& state, int layer, int word);

    osg::Texture* getCounter() { return _counter.get(); }
    /// The depths that layer `layer` has been peeled to.
    osg::Texture* getDepth(int layer);
    osg::Texture* getMask() { return _mask.get(); }
    osg::Texture* getLayers() { return _layerDepths.get(); }

    void releaseGLObjects(osg::State* state) const;

protected:
    ~ShadowTargets() override;

private:
    const TargetLayout _layout;
    std::optional<std::string> _whyIncomplete;
    Framebuffer _depth, _layer, _counting, _masking;
    osg::ref_ptr<TargetTexture> _opaqueDepth;
    osg::ref_ptr<TargetTexture> _peeledDepth[2]; ///< By turns.
    osg::ref_ptr<TargetTexture> _layerDepths;    ///< All layers; null without.
    osg::ref_ptr<TargetTexture> _counter;
    osg::ref_ptr<TargetTexture> _mask; ///< Words of the opaque surfaces, then of each layer.
};

} // namespace osgShadowVolume
