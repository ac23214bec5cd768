// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightShadows.h>
#include <osgShadowVolume/ShadowResources.h>

namespace osgShadowVolume
{

/// Shadows by silhouette volumes, right to the pixel.
///
/// Volumes count into a float target by additive blending instead of into a stencil: a count never
/// wraps, and an edge of multiplicity m is one quad of weight m. Where the count is not 0 the bit
/// of the light is set in a mask, which the surfaces look up when they are lit. So the lights are
/// evaluated in one pass, and no light is lost to the rounding of the framebuffer.
/// Kim, Kim, Turk: A Shadow-Volume Algorithm for Opaque and Transparent Nonmanifold Casters, JGT
/// 13(3), 2008; transparent receivers by depth peeling (Everitt, 2001).
class VolumeShadows : public LightShadows
{
public:
    VolumeShadows(const ShadowSettings& settings, ShadowResources& resources);
    ~VolumeShadows() override;

    void begin(osg::RenderInfo& renderInfo) override;
    bool receivesOnTransparent() const override { return getSettings().transparentLayers > 0; }
    void draw(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
              const std::vector<bool>& used,
              const std::function<bool(const osgMultiRender::SurfaceItem&)>& isReceiver) override;
    std::string makeSource(bool transparent) const override;
    std::vector<std::pair<std::string, int>> getSamplers() const override;
    const osg::StateSet* getStateSet() const override { return _lookUp.get(); }
    void apply(const osg::Program::PerContextProgram& program,
               const osg::GLExtensions& gl) const override;
    std::uint32_t getVariantBits() const override;
    void drawn(osg::RenderInfo& renderInfo) override;
    std::string describe(std::size_t light) const override;
    void fillPlan(osgMultiRender::Plan& plan) const override;

private:
    using Items = std::function<bool(const osgMultiRender::SurfaceItem&)>;

    void drawDepths(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                    const Items& isReceiver);
    osgMultiRender::SurfaceFrame::StateFor statesOf(ShadowPasses::Pass pass);
    /// Draws the next transparent layer; false when nothing is left.
    bool peel(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
              const Items& isReceiver, int layer);
    /// Takes targets for the lights that have volumes; false, and said, where OpenGL has none.
    bool acquireTargets(osg::State& state, const TargetLayout& layout);
    void makeMask(osg::RenderInfo& renderInfo, const std::vector<bool>& used, int layer);
    void resolve(osg::RenderInfo& renderInfo, int bit);
    const osg::ref_ptr<CasterMesh>& getMesh(std::size_t caster);
    void showVolumes(osg::RenderInfo& renderInfo);
    void drawVolumes(osg::RenderInfo& renderInfo, std::size_t light);

    ShadowResources& _resources;
    Technique _technique = Technique::CPU; ///< Of those that the context has.
    ShadowPasses::Tier _tier;
    int _viewSamples = 1;    ///< Of what the view draws into; the tier may have fewer.
    bool _isFlipped = false; ///< The target's samples lie upside down.
    osg::ref_ptr<ShadowTargets> _targets;
    unsigned int _contextID = 0;
    unsigned int _frameNumber = 0;
    std::vector<osg::ref_ptr<CasterMesh>> _meshes; ///< Parallel to the casters; null where unused.
    osg::ref_ptr<osg::StateSet> _lookUp;
    int _layers = 0;                ///< That were found in the view.
    bool _hasPolygonOffset = false; ///< Of a receiver.
    unsigned int _drawCalls = 0;
    std::vector<std::string> _descriptions;
};

} // namespace osgShadowVolume
