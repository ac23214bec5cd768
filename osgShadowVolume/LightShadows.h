// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterCollector.h>
#include <osgShadowVolume/LightReach.h>
#include <osgShadowVolume/LightScreen.h>
#include <osgShadowVolume/ShadowHull.h>
#include <osgShadowVolume/ShadowSettings.h>

#include <osgMultiRender/SurfaceFrame.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace osgShadowVolume
{

/// What becomes of one light's shadows in one view of one frame.
struct LightDecision
{
    /// Of the lights that cast visible shadows, from 0; -1 for one that does not.
    int index = -1;
    std::string reason; ///< Why it casts none: "no caster between it and what is in view".
    /// Casters that may throw shadows on what is in view, as indices.
    std::vector<std::uint32_t> casters;
    /// Parallel to `casters`: its volume may hold or cut the near rectangle.
    /// So does each where casters are seen through.
    std::vector<bool> needsZFail;
    ScreenBounds bounds; ///< Where it may light anything.
};

/// The shadows of all lights in one view of one frame: what takes light away, and how a lit surface
/// learns of it. A technique implements the draw half.
class LightShadows
{
public:
    explicit LightShadows(const ShadowSettings& settings) : _settings(settings) {}
    virtual ~LightShadows();

    /// In the cull thread: collects the casters of the group.
    void cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group);
    bool isDynamic() const { return _isDynamic; }

    // The rest is for the draw thread.

    /// Before anything else: what the context can do.
    virtual void begin(osg::RenderInfo& renderInfo) = 0;
    /// Decides on each light. `viewport` in pixels; `receivers` holds all that is in view, in eye
    /// coordinates. Beyond its limit a light need not cast shadows. The lights stay where they are
    /// until the frame is drawn.
    void plan(const glm::dvec4& viewport, const Hexahedron& receivers,
              const std::vector<EyeLight>& lights, const std::vector<double>& limits);
    /// What was decided on a light; indices are those of plan().
    const LightDecision& getDecision(std::size_t light) const { return _decisions[light]; }
    /// Whether the LightSource of a light in the group says castShadow=0.
    bool isShadowless(const osg::Light& light) const { return _shadowless.count(&light) != 0; }
    /// Whether a leaf can be in shadow: those of other projections than the group's (a head-up
    /// display in the model) and those without depth test keep their light.
    bool receives(const osgUtil::RenderLeaf& leaf, const osgMultiRender::SurfaceState& state) const;
    /// Whether surfaces that are not opaque receive shadows.
    virtual bool receivesOnTransparent() const = 0;

    /// Makes what the lights in use need, before the first leaf is drawn. `isReceiver` picks the
    /// leaves that look visibility up.
    virtual void
    draw(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
         const std::vector<bool>& used,
         const std::function<bool(const osgMultiRender::SurfaceItem&)>& isReceiver) = 0;
    /// GLSL that defines float osgsv_visible(float index, vec3 eyePosition).
    virtual std::string makeSource(bool transparent) const = 0;
    virtual std::vector<std::pair<std::string, int>> getSamplers() const = 0;
    /// What is pushed under the variants while leaves are drawn; null for nothing.
    virtual const osg::StateSet* getStateSet() const = 0;
    /// Sets uniforms of the program in use.
    virtual void apply(const osg::Program::PerContextProgram& program,
                       const osg::GLExtensions& gl) const = 0;
    /// Tells variants apart whose source differs: 0 to 7.
    virtual std::uint32_t getVariantBits() const = 0;
    /// The last leaf has been drawn.
    virtual void drawn(osg::RenderInfo& renderInfo) = 0;
    /// How the shadows of a light were made: "z-fail, 12 casters".
    virtual std::string describe(std::size_t light) const = 0;
    virtual void fillPlan(osgMultiRender::Plan& plan) const;

protected:
    const ShadowSettings& getSettings() const { return _settings; }
    const std::vector<Caster>& getCasters() const { return _casters; }
    const std::vector<EyeLight>& getLights() const { return *_lights; }
    /// Of the view.
    osg::RefMatrix* getProjection() const { return _projection.get(); }

private:
    struct Seen;
    /// Without an index; the reason is empty for a light that casts visible shadows.
    LightDecision decide(const EyeLight& light, double limit, const Seen& seen) const;
    /// What the light or the settings say against its shadows; null for nothing.
    const char* whyNoShadow(const EyeLight& light) const;

    const ShadowSettings _settings;
    bool _isDynamic = false;
    bool _isClipped = false; ///< Casters are seen through where a mirror clips them away.
    std::vector<Caster> _casters;
    std::set<const osg::Light*> _shadowless;
    std::map<std::string, unsigned int> _notCasting; ///< By reason, for the plan.
    osg::ref_ptr<osg::RefMatrix> _projection;
    const std::vector<EyeLight>* _lights = nullptr;
    std::vector<LightDecision> _decisions;
};

} // namespace osgShadowVolume
