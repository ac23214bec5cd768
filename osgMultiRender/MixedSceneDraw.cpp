// SPDX-License-Identifier: MIT
// How a MixedScene is traversed and drawn.
#include <osgMultiRender/MixedScene.h>

#include <osgMultiRender/MixDrag.h>
#include <osgMultiRender/MixFrame.h>
#include <osgMultiRender/MixKeys.h>
#include <osgMultiRender/MixMarkers.h>
#include <osgMultiRender/MixPass.h>

#include <osg/MatrixTransform>
#include <osgGA/EventVisitor>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

/// Some thousandths of the scene; made anew when points or the scene's size change.
osg::ref_ptr<osg::Node> MixedScene::makeMarks()
{
    const osg::BoundingSphere bound = getBound();
    std::lock_guard<std::mutex> lock(_settings);
    if (_marks == MixMarks::Off || _points.empty())
        return nullptr;
    const float size = bound.valid() ? std::max(0.012f * bound.radius(), 1e-6f) : 1.0f;
    if (!_drawnMarks || std::abs(size - _markSize) > 0.1f * size)
    {
        _drawnMarks =
            makeMixMarkers(_points, _snapshot->points->getMode(), _marks == MixMarks::Lines, size);
        _markSize = size;
    }
    return _drawnMarks;
}

void MixedScene::traverse(osg::NodeVisitor& visitor)
{
    if (auto* events = dynamic_cast<osgGA::EventVisitor*>(&visitor); events && getAnswersKeys())
        answerKeys(*this, *events, *_drag);
    const bool isCull = visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR;
    if (isCull && getInput() == MixInput::Frame)
        cullFrame(visitor);
    else
        SurfaceGroup::traverse(visitor);
    if (!isCull)
        return;
    if (const osg::ref_ptr<osg::Node> marks = makeMarks())
    {
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(keysToScene());
        place->addChild(marks);
        place->accept(visitor);
    }
}

/// Surfaces as they are, then the pass over the frame.
void MixedScene::cullFrame(osg::NodeVisitor& visitor)
{
    osg::Group::traverse(visitor);
    auto* cullVisitor = visitor.asCullVisitor();
    if (!cullVisitor || !cullVisitor->getCurrentRenderBin() || !cullVisitor->getModelViewMatrix())
        return;
    osg::ref_ptr<osg::StateSet> state;
    {
        std::lock_guard<std::mutex> lock(_settings);
        if (!_frameState)
            _frameState = makeMixFrameState();
        state = _frameState;
    }
    addMixFrame(*cullVisitor, *state, getBound(), getResources(), getSnapshot(), keysToScene());
}

std::vector<Plan> MixedScene::getPlans() const
{
    if (getInput() == MixInput::Surface)
        return SurfaceGroup::getPlans();
    const std::shared_ptr<MixResources> resources = getResources();
    std::lock_guard<std::mutex> lock(resources->mutex);
    std::vector<Plan> plans;
    for (const auto& [camera, plan] : resources->framePlans)
        plans.push_back(plan);
    return plans;
}

std::string MixedScene::getSource() const
{
    return getResources()->programs.getSource();
}

/// From the node that the key points are attached to.
osg::Matrixd MixedScene::keysToScene() const
{
    osg::ref_ptr<osg::Node> node;
    {
        std::lock_guard<std::mutex> lock(_settings);
        if (!_keyNode.lock(node))
            return {};
    }
    const auto pathOf = [](const osg::Node& of)
    {
        const osg::NodePathList paths = of.getParentalNodePaths();
        return paths.empty() ? osg::NodePath() : paths.front();
    };
    // Through the world: the node need not be of this subgraph.
    return osg::computeLocalToWorld(pathOf(*node)) * osg::computeWorldToLocal(pathOf(*this));
}

std::unique_ptr<SurfacePass> MixedScene::createPass() const
{
    return std::make_unique<MixPass>(getResources(), getSnapshot(), keysToScene());
}

void MixedScene::resizeGLObjectBuffers(unsigned int maxSize)
{
    SurfaceGroup::resizeGLObjectBuffers(maxSize);
    const std::shared_ptr<MixResources> resources = getResources();
    resources->programs.resizeGLObjectBuffers(maxSize);
    std::lock_guard<std::mutex> lock(resources->mutex);
    for (auto& [context, states] : resources->free)
        for (auto& state : states)
            state->getStateSet()->resizeGLObjectBuffers(maxSize);
}

void MixedScene::releaseGLObjects(osg::State* state) const
{
    SurfaceGroup::releaseGLObjects(state);
    const std::shared_ptr<MixResources> resources = getResources();
    resources->frames.releaseGLObjects(state);
    resources->programs.releaseGLObjects(state);
    std::lock_guard<std::mutex> lock(resources->mutex);
    for (const auto& [context, states] : resources->free)
        for (const auto& each : states)
            each->getStateSet()->releaseGLObjects(state);
}

} // namespace osgMultiRender
