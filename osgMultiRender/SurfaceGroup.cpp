// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceGroup.h>

#include <osgMultiRender/SurfaceFrame.h>
#include <osgMultiRender/WithheldLight.h>

#include <osg/Camera>
#include <osg/Notify>
#include <osgUtil/CullVisitor>
#include <osgUtil/PositionalStateContainer>

namespace osgMultiRender
{

namespace
{

/// A stage that belongs to a SurfaceGroup, so that a nested one sees that it is nested.
class PrivateStage : public osgUtil::RenderStage
{
};

/// Replaces the lights that GL does not know in the view's list of positioned attributes.
void withholdExtraLights(osgUtil::PositionalStateContainer& container)
{
    for (auto& [attribute, matrix] : container.getAttrMatrixList())
        if (auto* light = dynamic_cast<const osg::Light*>(attribute.get()))
            if (light->getLightNum() >= int(SurfaceState::MaxGLLights))
                attribute = new WithheldLight(light, light->getLightNum());
}

} // namespace

SurfacePass::~SurfacePass() = default;

SurfaceGroup::SurfaceGroup() : _scope(new osg::StateSet) {}

SurfaceGroup::SurfaceGroup(const SurfaceGroup& other, const osg::CopyOp& copyop)
    : osg::Group(other, copyop), _scope(new osg::StateSet)
{
}

SurfaceGroup::~SurfaceGroup() = default;

void SurfaceGroup::traverse(osg::NodeVisitor& visitor)
{
    auto* cullVisitor = visitor.asCullVisitor();
    if (visitor.getVisitorType() != osg::NodeVisitor::CULL_VISITOR || !cullVisitor ||
        dynamic_cast<PrivateStage*>(cullVisitor->getCurrentRenderBin()->getStage()))
        osg::Group::traverse(visitor);
    else
        cull(*cullVisitor);
}

void SurfaceGroup::cull(osgUtil::CullVisitor& visitor)
{
    osgUtil::RenderBin* bin = visitor.getCurrentRenderBin();
    osg::ref_ptr<SurfaceFrame> frame = new SurfaceFrame(*this, *bin, *new PrivateStage);
    visitor.pushStateSet(_scope.get());
    visitor.setCurrentRenderBin(&frame->getPrivateStage());
    osg::Group::traverse(visitor);
    visitor.setCurrentRenderBin(bin);
    visitor.popStateSet();
    frame->insertProxies(visitor);
    withholdExtraLights(*bin->getStage()->getPositionalStateContainer());
}

void SurfaceGroup::resizeGLObjectBuffers(unsigned int maxSize)
{
    osg::Group::resizeGLObjectBuffers(maxSize);
    SurfaceVariantCache::instance().resizeGLObjectBuffers(maxSize);
}

void SurfaceGroup::releaseGLObjects(osg::State* state) const
{
    osg::Group::releaseGLObjects(state);
    SurfaceVariantCache::instance().releaseGLObjects(state);
}

const osg::StateSet* SurfaceGroup::getProxyStateSet(int bin)
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& stateSet = _proxyStateSets[bin];
    if (!stateSet)
    {
        stateSet = new osg::StateSet;
        stateSet->setThreadSafeRefUnref(true);
    }
    return stateSet.get();
}

void SurfaceGroup::setPlan(const osg::Camera* camera, Plan plan)
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::size_t index = 0;
    while (index < _plans.size() && _plans[index].camera.get() != camera)
        ++index;
    if (index == _plans.size())
        _plans.push_back({camera, {}});
    plan.view = camera && !camera->getName().empty() ? camera->getName()
                                                     : "camera " + std::to_string(index);
    _compiled += plan.counts["programs.compiledThisFrame"];
    plan.counts["programs.compiled"] = _compiled;
    plan.counts["programs.reused"] = plan.counts["states"] - plan.counts["programs.compiledThisFrame"];
    _plans[index].plan = std::move(plan);
    OSG_INFO << toString(_plans[index].plan) << std::flush;
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
