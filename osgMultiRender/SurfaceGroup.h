// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/Plan.h>
#include <osgMultiRender/SurfaceVariant.h>

#include <osg/Group>
#include <osg/observer_ptr>

#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace osgUtil
{
class CullVisitor;
class RenderLeaf;
class StateGraph;
} // namespace osgUtil

namespace osgMultiRender
{

class SurfaceFrame;
class SurfaceGroup;
struct SurfaceItem;

/// What a pass contributes. Of kits with the same role inside of each other the outermost one
/// counts; siblings inside of another kit each have theirs.
enum class SurfaceRole : std::uint8_t
{
    Light,   ///< How surfaces are lit: SurfaceKey::kit.
    Output,  ///< What is written beside and after the colour: SurfaceKey::output.
    Surface, ///< What surfaces look like instead of their own look: look().
    Texture  ///< What texture units give to a surface's own look: SurfaceKey::texture.
};

/// A kit's part in the draw of one view of one frame. Lives in the draw thread.
class OSGMULTIRENDER_EXPORT SurfacePass
{
public:
    virtual ~SurfacePass();

    virtual SurfaceRole getRole() const { return SurfaceRole::Light; }

    /// In the cull thread, when the subgraph has been traversed; `visitor` still stands at `group`.
    /// Leaves of the group have `scope` on the path to their StateGraphs; null: all of the stage
    /// are. Called once for each place of the group in an outer one.
    virtual void cull(osgUtil::CullVisitor& visitor, SurfaceGroup& group,
                      const osg::StateSet* scope);
    /// Whether the draw reads what the update may change, beside the leaves in view. Called after
    /// cull().
    virtual bool isDynamic() const { return false; }

    // The rest is called in the draw thread.

    /// Where light is evaluated this frame. Asked of the pass with SurfaceRole::Light; without one
    /// per vertex.
    virtual LightingMode getLighting() const { return LightingMode::Vertex; }
    /// Collects what the frame needs; called once before anything else.
    virtual void begin(osg::RenderInfo& renderInfo, const SurfaceFrame& frame) = 0;
    /// Says which bits of its own a leaf's key gets, and gives the leaf a number for apply().
    /// `ordered` tells that the leaf lies in a bin sorted by depth or traversal. With
    /// SurfaceRole::Light only for leaves whose key has LightingMode::Pixel, and for others without
    /// a program of their own if classifiesUnlit(); with SurfaceRole::Texture only for leaves
    /// without a program or look.
    virtual void classify(const SurfaceState& state, const osgUtil::RenderLeaf& leaf, bool ordered,
                          SurfaceKey& key, std::uint32_t& number) = 0;
    virtual bool classifiesUnlit() const { return false; }
    /// With SurfaceRole::Surface: what the leaf looks like instead of its own look; null keeps
    /// that. Not asked for leaves whose program places their vertices or is PROTECTED. What is
    /// returned lives until drawn().
    virtual SurfaceLook* look(const SurfaceState& state, const osgUtil::RenderLeaf& leaf);
    /// After the last classify().
    virtual void end(osg::RenderInfo& renderInfo) = 0;
    /// After end(), before the first leaf is drawn: what is drawn elsewhere first. Leaves the
    /// framebuffer, the viewport and osg::State's stack as they were.
    virtual void drawBefore(osg::RenderInfo& renderInfo, SurfaceFrame& frame);
    /// Whether the leaf, of a bin sorted by state, is drawn through divert(). After end().
    virtual bool diverts(const SurfaceItem& item) const;
    /// Draws the diverted leaves of one bin: sets a target of its own, calls `draw`, puts the
    /// result into the view. Leaves the framebuffer, the viewport and osg::State's stack as they
    /// were.
    virtual void divert(osg::RenderInfo& renderInfo, const std::function<void()>& draw);
    /// The last leaf of the frame has been drawn.
    virtual void drawn(osg::RenderInfo& renderInfo);
    /// The GLSL that a key with these bits needs; empty for a key without any that are the pass's.
    virtual SurfaceSnippet makeSnippet(const SurfaceKey& key) const = 0;
    /// Called before each run of leaves: since the last one other passes may have used the same
    /// programs and textures. Returns what is pushed under the variants during the run; null for
    /// none.
    virtual const osg::StateSet* startRun() = 0;
    /// Called with the variant's program in use, before the leaf is drawn, where the key has bits
    /// of the pass or the look is its.
    virtual void apply(osg::RenderInfo& renderInfo, const SurfaceVariant& variant,
                       const osgUtil::RenderLeaf& leaf, std::uint32_t number) = 0;
    virtual void fillPlan(Plan& plan) const = 0;
};

/// A Group whose subgraph is drawn with surface functions instead of the fixed function.
///
/// Under a cull traversal it collects the subgraph in a stage of its own and leaves one proxy a
/// render bin in the bins of the view, so that the order among siblings stays; to every other
/// visitor it is a plain group. The subgraph's StateSets are never written, state above the group
/// and changes at run time count. Nested in another SurfaceGroup it hands that one its pass for its
/// own leaves: one collection and one program a variant, whichever kit is the outer one. Requires
/// GL 3.3 compatibility; below that it says so once and the fixed function draws.
class OSGMULTIRENDER_EXPORT SurfaceGroup : public osg::Group, public Planned
{
public:
    SurfaceGroup();
    SurfaceGroup(const SurfaceGroup& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    void traverse(osg::NodeVisitor& visitor) override;
    void resizeGLObjectBuffers(unsigned int maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

    std::vector<Plan> getPlans() const override;

protected:
    ~SurfaceGroup() override;

    /// What a cull traversal goes through: the children, unless a kit has something that draws the
    /// same.
    virtual void cullSubgraph(osg::NodeVisitor& visitor);
    /// The kit's part in a new frame of a view. Called in the cull thread.
    virtual std::unique_ptr<SurfacePass> createPass() const = 0;

private:
    friend class SurfaceFrame;

    using StateSets = std::vector<osg::ref_ptr<osg::StateSet>>;

    void cull(osgUtil::CullVisitor& visitor);
    void cullNested(osgUtil::CullVisitor& visitor, SurfaceFrame& frame);
    /// Pushes a StateSet that keeps the subgraph's leaves apart from those of siblings, and of this
    /// group itself where the view has met it before (under another parent). Returns where proxies
    /// belong: at the root, so that no state of the subgraph is left to OSG when they are drawn.
    osgUtil::StateGraph& pushScope(osgUtil::CullVisitor& visitor);
    void setPlan(const osg::Camera* camera, Plan plan);
    /// A program of the frame whose plan is set did not link.
    void addFailure(const osg::Camera* camera);
    /// A StateSet of its own for each bin of proxies, so that they do not share StateGraphs.
    const osg::StateSet* getProxyStateSet(std::size_t bin) { return nthStateSet(_proxies, bin); }
    const osg::StateSet* nthStateSet(StateSets& stateSets, std::size_t index);

    mutable std::mutex _mutex;
    StateSets _scopes;
    StateSets
        _nested; ///< Tell the leaves of this group, one a place, from others of the outer one.
    StateSets _proxies;
    struct ViewPlan
    {
        osg::observer_ptr<const osg::Camera> camera;
        bool hasCamera = false;
        Plan plan;
    };
    std::vector<ViewPlan> _plans;
    double _compiled = 0.0; ///< Programs made for this group.
};

} // namespace osgMultiRender
