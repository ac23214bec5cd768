// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/SurfaceGroup.h>

#include <osgUtil/CullVisitor>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <functional>
#include <set>
#include <unordered_map>

namespace osgMultiRender
{

/// The passes of a leaf in a SurfaceFrame, by role: their places, or NoPass.
using SurfacePasses = std::array<std::uint16_t, 4>;
constexpr std::uint16_t NoPass = 0xffff;
constexpr SurfacePasses NoPasses = {NoPass, NoPass, NoPass, NoPass};

/// One leaf of the subgraph and what draws it.
struct SurfaceItem
{
    osgUtil::RenderLeaf* leaf = nullptr;
    SurfaceVariant* variant = nullptr;      ///< Null: the leaf keeps its own state.
    std::array<std::uint32_t, 4> numbers{}; ///< The passes' numbers of the leaf, by role.
    SurfacePasses passes = NoPasses;
    bool diverted = false;                 ///< Drawn through SurfacePass::divert().
    std::uint32_t order = 0;               ///< Of the variant, by first appearance in the frame.
    const SurfaceState* state = nullptr;   ///< Of the leaf; null below OpenGL 3.3.
    const std::string* instance = nullptr; ///< GLSL of its VertexSnippet; null for none.
    SurfaceLook* look = nullptr; ///< What draws it instead of its own state; null for none.

    /// Whether the pass of the role has a part in its variant.
    bool wants(std::size_t role) const
    {
        switch (static_cast<SurfaceRole>(role))
        {
        case SurfaceRole::Light:
            return variant->getKey().kit;
        case SurfaceRole::Output:
            return variant->getKey().output;
        case SurfaceRole::Texture:
            return variant->getKey().texture;
        default:
            return look;
        }
    }
};

/// The subgraph of a SurfaceGroup in one view of one frame: collected in cull, drawn by proxies.
///
/// The subgraph's leaves lie in a private RenderStage. Each of its bins is mirrored in the bins of
/// the view: a bin sorted by state by one proxy leaf that draws all its leaves, a bin sorted by
/// depth or traversal by one proxy a leaf, so that they sort together with the leaves of siblings.
class OSGMULTIRENDER_EXPORT SurfaceFrame : public osg::Referenced
{
public:
    /// `stage` collects the subgraph; the frame owns it.
    SurfaceFrame(SurfaceGroup& group, osgUtil::RenderBin& bin, osgUtil::RenderStage& stage);

    /// The pass of the group that draws.
    SurfacePass& getOwnPass() { return *_passes.front().pass; }
    SurfaceGroup& getGroup() { return *_group; }
    struct Nested
    {
        const osg::StateSet* scope = nullptr; ///< What the leaves have to be traversed under.
        SurfacePass* pass = nullptr; ///< Null where a group around it has one with this role.
    };
    /// The traversal enters a nested group, perhaps not for the first time.
    Nested enter(SurfaceGroup& group);
    /// It leaves the one that it has entered last.
    void leave() { _open.pop_back(); }
    bool isDynamic() const;

    /// The stage to traverse the subgraph with.
    osgUtil::RenderStage& getPrivateStage() { return *_private; }
    /// After the traversal: puts proxies into the bins of the view, below `graph`, and returns
    /// them. OSG looks at the last leaf drawn when the stage is done and its StateGraphs are
    /// empty: the proxies have to be kept until the stage is culled again.
    std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> insertProxies(osgUtil::StateGraph& graph);

    /// The stage of the view, which holds the positioned lights.
    const osgUtil::RenderStage& getStage() const { return *_stage; }

    /// Calls `f` for each light positioned in this view, in the order in which GL gets them, with
    /// its matrix to eye coordinates (null for identity). The viewer's headlight has no place in
    /// the scene; in a picture inside of the view it has a matrix like any other.
    void forEachLight(const std::function<void(const osg::Light&, const osg::Matrix*,
                                               bool isHeadlight)>& f) const;

    /// Box of all leaves that have a bound, in eye coordinates times `matrix`; invalid for none.
    /// Leaves without a bound make it infinite in fact: then `unbounded` is set.
    osg::BoundingBoxd getBounds(const osg::Matrixd& matrix, bool& unbounded) const;

    /// Draws the leaves of one mirrored bin, or one leaf.
    void drawBin(osg::RenderInfo& renderInfo, std::size_t bin);
    void drawLeaf(osg::RenderInfo& renderInfo, std::size_t bin, std::size_t leaf);

    /// To be called once by each proxy when it has been drawn.
    void proxyDrawn(osg::RenderInfo& renderInfo);
    bool isEmpty() const { return _bins.empty(); }
    /// Instead of all that, for an empty one.
    void drawNothing(osg::RenderInfo& renderInfo);

    /// Calls `f` for each leaf of the scope of `pass`, and tells whether it lies in a bin sorted by
    /// depth or traversal.
    void forEachLeaf(const SurfacePass& pass,
                     const std::function<void(const osgUtil::RenderLeaf&, bool ordered)>& f) const;
    /// Calls `f` for each leaf. Only from SurfacePass::end() on.
    void forEachItem(const std::function<void(const SurfaceItem&)>& f) const;
    /// Whether the leaf lies in the scope of the pass.
    bool isOf(const SurfacePass& pass, const SurfaceItem& item) const;

    /// The StateSet for leaves with a VertexSnippet of this GLSL; null for those without.
    using StateFor = std::function<const osg::StateSet&(const std::string* instance)>;

    /// Draws the leaves that `select` picks into the current framebuffer, with what `over` gives
    /// over their own state: a StateSet whose attributes and modes have OVERRIDE. Where it has a
    /// Program, this one draws, and has to place vertices as the VertexSnippet does; where it has
    /// none, the leaf's variant draws. Leaves without a variant are left out.
    void drawSelected(osg::RenderInfo& renderInfo, const StateFor& over,
                      const std::function<bool(const SurfaceItem&)>& select);

    /// Draws leaves once more into the current framebuffer, by programs for other keys than their
    /// own. `rekey` makes a leaf's key another one, or returns false to leave it out; a leaf that
    /// keeps the fixed function comes with a plain key. `over` as in drawSelected(), without a
    /// Program. Returns how many leaves can't be drawn so: their own programs can't be wrapped.
    std::size_t drawAs(osg::RenderInfo& renderInfo, const osg::StateSet& over,
                       const std::function<bool(const SurfaceItem&, SurfaceKey&)>& rekey);

    const std::vector<osgUtil::RenderLeaf*>& getLeaves(std::size_t bin) const { return _bins[bin]; }

protected:
    ~SurfaceFrame() override;

private:
    void addProxy(osgUtil::StateGraph& graph, osgUtil::RenderLeaf* proxy);
    void mirrorLeaves(osgUtil::StateGraph& proxies, osgUtil::RenderBin& from,
                      osgUtil::RenderBin& to);
    void mirror(osgUtil::StateGraph& proxies, osgUtil::RenderBin& from, osgUtil::RenderBin& to);
    void prepare(osg::RenderInfo& renderInfo);
    struct Pass
    {
        osg::ref_ptr<SurfaceGroup> group;
        std::unique_ptr<SurfacePass> pass;
        std::size_t role() const { return static_cast<std::size_t>(pass->getRole()); }
    };
    static constexpr std::size_t LightRole = static_cast<std::size_t>(SurfaceRole::Light);
    static constexpr std::size_t OutputRole = static_cast<std::size_t>(SurfaceRole::Output);
    static constexpr std::size_t LookRole = static_cast<std::size_t>(SurfaceRole::Surface);
    static constexpr std::size_t TextureRole = static_cast<std::size_t>(SurfaceRole::Texture);
    /// What the leaves of one StateGraph have in common.
    struct Surface
    {
        SurfacePasses passes = NoPasses;
        SurfaceLook* look = nullptr;           ///< Of the pass with SurfaceRole::Surface.
        const osg::Program* program = nullptr; ///< The model's own, or that of the look.
        const std::string* instance = nullptr; ///< GLSL of a VertexSnippet.
        const SurfaceState* state = nullptr;
        SurfaceKey key;                    ///< With the kit bits of the last leaf.
        SurfaceVariant* variant = nullptr; ///< Of that key; null before it is looked up.
        std::pair<const std::string, unsigned int>* beyond = nullptr; ///< In _beyond.
    };
    Surface& surfaceOf(osg::RenderInfo& renderInfo, const osgUtil::StateGraph* graph,
                       SurfaceLook* look);
    SurfaceLook* lookOf(const osgUtil::RenderLeaf& leaf, const SurfacePasses& passes);
    SurfacePasses passesOf(const osgUtil::StateGraph* graph) const;
    LightingMode lightingOf(const SurfacePasses& passes) const;
    const osg::StateSet* mergeUnder(const SurfacePasses& passes);
    void resolve(osg::State& state, Surface& surface, osgUtil::RenderLeaf& leaf, bool ordered,
                 SurfaceItem& item);
    void classify(const Surface& surface, const osgUtil::RenderLeaf& leaf, bool ordered,
                  SurfaceKey& key, SurfaceItem& item);
    SurfaceSnippet makeSnippet(const SurfaceKey& key, const SurfacePasses& passes,
                               bool hasProgram) const;
    bool links(osg::State& state, SurfaceVariant& variant, const SurfacePasses& passes);
    void sayTooOld(float glVersion);
    void classifyAll(osg::RenderInfo& renderInfo);
    void withholdLights();
    void sortItems();
    const SurfaceState& stateOf(const osgUtil::StateGraph* graph);
    SurfaceVariant* variantOf(const SurfaceKey& key, const Surface& surface);
    SurfaceVariant* wrapperOf(const osg::Program& program);
    void reportFailure(osg::State& state, SurfaceVariant& variant);
    void draw(osg::RenderInfo& renderInfo, const SurfaceItem* items, std::size_t count);
    void drawRun(osg::RenderInfo& renderInfo, const SurfaceItem* items, std::size_t count);
    void drawOne(osg::RenderInfo& renderInfo, const SurfaceItem& item,
                 osgUtil::RenderLeaf* previous);
    void writePlan(osg::RenderInfo& renderInfo);

    osg::ref_ptr<SurfaceGroup> _group;
    osg::ref_ptr<osgUtil::RenderBin> _bin;
    osg::ref_ptr<osgUtil::RenderStage> _stage;
    osg::ref_ptr<osgUtil::RenderStage> _private;
    std::vector<Pass> _passes; ///< The group's own first.
    /// Those of the nested ones, by what their leaves were traversed under.
    std::unordered_map<const osg::StateSet*, std::uint16_t> _scopes;
    std::map<const SurfaceGroup*, std::size_t> _entered; ///< How often.
    std::vector<std::uint16_t> _open;    ///< Passes of the groups that the traversal is in.
    std::vector<std::size_t> _diverted;  ///< One a bin: so many of its first items.
    osg::ref_ptr<osg::StateSet> _merged; ///< What several passes want below the variants.
    std::vector<const osg::StateSet*> _mergedFrom;
    std::vector<std::vector<osgUtil::RenderLeaf*>> _bins;
    std::vector<bool> _isOrdered; ///< One a bin: by depth or traversal, one proxy a leaf.
    std::size_t _proxies = 0;     ///< Still to be drawn.
    std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> _made;

    bool _prepared = false;
    float _languageVersion = 0.0f;
    GLLights _lights{};
    std::unordered_map<const osgUtil::StateGraph*, SurfaceState> _states;
    std::map<std::pair<const osgUtil::StateGraph*, SurfaceLook*>, Surface> _surfaces;
    std::map<SurfacePasses,
             std::unordered_map<SurfaceKey, osg::ref_ptr<SurfaceVariant>, SurfaceKeyHash>>
        _variants;
    std::unordered_map<const osg::Program*, SurfaceVariant*> _wrappers;
    std::set<const SurfaceVariant*> _failedWrappers; ///< Their leaves show the fixed-function look.
    std::set<const SurfaceVariant*> _failedOutputs;  ///< Their leaves are drawn without the output.
    std::vector<std::vector<SurfaceItem>> _items;    ///< One a bin, grouped by variant.
    std::map<std::string, unsigned int> _beyond;     ///< Why leaves keep the fixed function.
    unsigned int _compiled = 0;
    osg::ref_ptr<const osg::StateSet> _withheld;
};

} // namespace osgMultiRender
