// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceGroup.h>

#include <osgMultiRender/SurfaceFrame.h>
#include <osgMultiRender/WithheldLights.h>

#include <osg/Camera>
#include <osg/Notify>
#include <osgUtil/CullVisitor>
#include <osgUtil/PositionalStateContainer>

#include <algorithm>
#include <limits>

namespace osgMultiRender
{

namespace
{

/// A stage that belongs to a SurfaceGroup, so that a nested one sees that it is nested.
class PrivateStage : public osgUtil::RenderStage
{
public:
    SurfaceFrame* frame = nullptr; ///< Owns the stage.
};

/// Replaces the lights that GL does not know in a list of positioned attributes.
void withholdExtraLights(osgUtil::PositionalStateContainer* container)
{
    if (!container)
        return;
    auto& list = container->getAttrMatrixList();
    osg::ref_ptr<WithheldLights> withheld = new WithheldLights;
    const auto end =
        std::remove_if(list.begin(), list.end(),
                       [&withheld](const auto& entry)
                       {
                           auto* light = dynamic_cast<const osg::Light*>(entry.first.get());
                           if (!light || light->getLightNum() < int(SurfaceState::MaxGLLights))
                               return false;
                           withheld->getLights().push_back({light, entry.second});
                           return true;
                       });
    if (end == list.end())
        return;
    list.erase(end, list.end());
    list.emplace_back(withheld, nullptr);
}

/// Drawn before the stage of a view, when all of its lights are known: also those of siblings that
/// come after the group.
class LightGate : public osgUtil::RenderStage
{
public:
    /// `stage` owns the gate.
    explicit LightGate(osgUtil::RenderStage& stage) : _stage(stage) {}

    /// Keeps leaves as long as the stage has its pre-render stages: until its next cull.
    void keep(std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> leaves) { _kept = std::move(leaves); }

    /// For a frame that has no leaf.
    void drawInstead(SurfaceFrame& frame) { _empty = &frame; }

    void draw(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*&) override
    {
        if (_empty)
            _empty->drawNothing(renderInfo);
        _empty = nullptr;
        withholdExtraLights(_stage.getInheritedPositionalStateContainer());
        withholdExtraLights(_stage.getPositionalStateContainer());
    }

private:
    osgUtil::RenderStage& _stage;
    std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> _kept;
    osg::ref_ptr<SurfaceFrame> _empty;
};

/// What pushScope() marks the StateGraphs in use with; these are emptied before each traversal.
struct ScopeMark
{
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    osg::ref_ptr<osg::Drawable> drawable = new osg::Drawable;

    static const ScopeMark& instance()
    {
        static const ScopeMark mark;
        return mark;
    }
};

} // namespace

SurfacePass::~SurfacePass() = default;

void SurfacePass::cull(osgUtil::CullVisitor&, SurfaceGroup&, const osg::StateSet*) {}

SurfaceLook* SurfacePass::look(const SurfaceState&, const osgUtil::RenderLeaf&)
{
    return nullptr;
}

void SurfacePass::drawBefore(osg::RenderInfo&, SurfaceFrame&) {}

bool SurfacePass::diverts(const SurfaceItem&) const
{
    return false;
}

void SurfacePass::divert(osg::RenderInfo&, const std::function<void()>& draw)
{
    draw();
}

void SurfacePass::drawn(osg::RenderInfo&) {}

SurfaceGroup::SurfaceGroup() = default;

SurfaceGroup::SurfaceGroup(const SurfaceGroup& other, const osg::CopyOp& copyop)
    : osg::Group(other, copyop)
{
}

SurfaceGroup::~SurfaceGroup() = default;

void SurfaceGroup::traverse(osg::NodeVisitor& visitor)
{
    auto* cullVisitor = visitor.asCullVisitor();
    if (visitor.getVisitorType() != osg::NodeVisitor::CULL_VISITOR || !cullVisitor ||
        !cullVisitor->getCurrentRenderBin())
        osg::Group::traverse(visitor);
    else if (auto* outer =
                 dynamic_cast<PrivateStage*>(cullVisitor->getCurrentRenderBin()->getStage()))
        cullNested(*cullVisitor, *outer->frame);
    else
        cull(*cullVisitor);
}

void SurfaceGroup::cull(osgUtil::CullVisitor& visitor)
{
    osgUtil::RenderBin* bin = visitor.getCurrentRenderBin();
    osg::ref_ptr<PrivateStage> stage = new PrivateStage;
    osg::ref_ptr<SurfaceFrame> frame = new SurfaceFrame(*this, *bin, *stage);
    stage->frame = frame.get();
    osg::ref_ptr<LightGate> gate = new LightGate(*bin->getStage());
    bin->getStage()->addPreRenderStage(gate, std::numeric_limits<int>::min());
    osgUtil::StateGraph& proxies = pushScope(visitor);
    visitor.setCurrentRenderBin(&frame->getPrivateStage());
    cullSubgraph(visitor);
    frame->getOwnPass().cull(visitor, *this, nullptr);
    visitor.setCurrentRenderBin(bin);
    visitor.popStateSet();
    gate->keep(frame->insertProxies(proxies));
    if (frame->isEmpty())
        gate->drawInstead(*frame);
}

void SurfaceGroup::cullSubgraph(osg::NodeVisitor& visitor)
{
    osg::Group::traverse(visitor);
}

void SurfaceGroup::cullNested(osgUtil::CullVisitor& visitor, SurfaceFrame& frame)
{
    const SurfaceFrame::Nested nested = frame.enter(*this);
    visitor.pushStateSet(nested.scope);
    cullSubgraph(visitor);
    if (nested.pass)
        nested.pass->cull(visitor, *this, nested.scope);
    visitor.popStateSet();
    frame.leave();
}

osgUtil::StateGraph& SurfaceGroup::pushScope(osgUtil::CullVisitor& visitor)
{
    osgUtil::StateGraph* root = visitor.getCurrentStateGraph();
    while (root->_parent)
        root = root->_parent;
    const ScopeMark& mark = ScopeMark::instance();
    for (std::size_t i = 0;; ++i)
    {
        const osg::StateSet* scope = nthStateSet(_scopes, i);
        osgUtil::StateGraph* proxies = root->find_or_insert(scope);
        osgUtil::StateGraph* marked = proxies->find_or_insert(mark.stateSet.get());
        if (!marked->leaves_empty())
            continue;
        marked->addLeaf(new osgUtil::RenderLeaf(mark.drawable.get(), nullptr, nullptr));
        visitor.pushStateSet(scope);
        return *proxies;
    }
}

void SurfaceGroup::resizeGLObjectBuffers(unsigned int maxSize)
{
    osg::Group::resizeGLObjectBuffers(maxSize);
    SurfaceVariantCache::instance().resizeGLObjectBuffers(maxSize);
}

void SurfaceGroup::releaseGLObjects(osg::State* state) const
{
    osg::Group::releaseGLObjects(state);
    // Without a State this would take the programs from under other groups, in whichever thread
    // they draw: a subgraph that the pager drops is released so.
    if (state)
        SurfaceVariantCache::instance().releaseGLObjects(state);
}

const osg::StateSet* SurfaceGroup::nthStateSet(StateSets& stateSets, std::size_t index)
{
    std::lock_guard<std::mutex> lock(_mutex);
    while (stateSets.size() <= index)
    {
        stateSets.push_back(new osg::StateSet);
        stateSets.back()->setThreadSafeRefUnref(true);
    }
    return stateSets[index].get();
}

void SurfaceGroup::setPlan(const osg::Camera* camera, Plan plan)
{
    std::lock_guard<std::mutex> lock(_mutex);
    // Views that are gone have no plan.
    _plans.erase(std::remove_if(_plans.begin(), _plans.end(),
                                [](const ViewPlan& view)
                                { return view.hasCamera && !view.camera.valid(); }),
                 _plans.end());
    std::size_t index = 0;
    while (index < _plans.size() && _plans[index].camera.get() != camera)
        ++index;
    if (index == _plans.size())
        _plans.push_back({camera, camera != nullptr, {}});
    plan.view = camera && !camera->getName().empty() ? camera->getName()
                                                     : "camera " + std::to_string(index);
    _compiled += plan.counts["programs.compiledThisFrame"];
    plan.counts["programs.compiled"] = _compiled;
    // States that are drawn by a program that another one has brought in.
    plan.counts["programs.reused"] = std::max(0.0, plan.counts["states"] - plan.counts["variants"]);
    _plans[index].plan = std::move(plan);
    OSG_INFO << toString(_plans[index].plan) << std::flush;
}

void SurfaceGroup::addFailure(const osg::Camera* camera)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (ViewPlan& view : _plans)
        if (view.camera.get() == camera)
            ++view.plan.counts["variants.failed"];
}

std::vector<Plan> SurfaceGroup::getPlans() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<Plan> plans;
    for (const ViewPlan& view : _plans)
        plans.push_back(view.plan);
    return plans;
}

} // namespace osgMultiRender
