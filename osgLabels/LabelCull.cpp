// SPDX-License-Identifier: MIT
// The part of LabelPass that runs in the cull thread: which objects are in view, and what is asked.
#include <osgLabels/LabelPass.h>

#include <osgLabels/ChunkMesh.h>
#include <osgLabels/MapPass.h>
#include <osgLabels/PrimitiveRun.h>

#include <osg/Geometry>
#include <osgUtil/CullVisitor>

#include <algorithm>

namespace osgLabels
{

namespace
{

/// Whether the StateSet is on the path to the graph.
bool isBelow(const osgUtil::StateGraph* graph, const osg::StateSet& scope)
{
    while (graph && graph->getStateSet() != &scope)
        graph = graph->_parent;
    return graph;
}

/// Of the scope, or of all where it is null.
void forEachLeaf(osgUtil::RenderBin& bin, const osg::StateSet* scope,
                 const std::function<void(const osgUtil::RenderLeaf&)>& f)
{
    for (const osgUtil::StateGraph* graph : bin.getStateGraphList())
        if (!scope || isBelow(graph, *scope))
            for (const auto& leaf : graph->_leaves)
                f(*leaf);
    for (const auto& [number, inner] : bin.getRenderBinList())
        forEachLeaf(*inner, scope, f);
}

/// Points have no surface to write on.
bool isPoints(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry || geometry->getNumPrimitiveSets() == 0)
        return false;
    const osg::Geometry::PrimitiveSetList& sets = geometry->getPrimitiveSetList();
    return std::all_of(sets.begin(), sets.end(),
                       [](const auto& primitives) { return primitives->getMode() == GL_POINTS; });
}

} // namespace

void LabelPass::cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group,
                     const osg::StateSet* scope)
{
    takeQuestions(visitor);
    if (!_resources || !_resources->collector)
        return;
    std::vector<const osgUtil::RenderLeaf*> leaves;
    forEachLeaf(*visitor.getCurrentRenderBin()->getStage(), scope,
                [&](const osgUtil::RenderLeaf& leaf) { leaves.push_back(&leaf); });
    if (!_ticket)
        _ticket = _resources->shared->frames.begin();
    if (_resources->hasSurfaceLabels())
        findObjects(visitor, group, leaves);
    if (_map)
        _map->cull(visitor, group, leaves);
}

void LabelPass::findObjects(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group,
                            const std::vector<const osgUtil::RenderLeaf*>& leaves)
{
    std::vector<std::pair<const osgUtil::RenderLeaf*, std::uint32_t>> objects;
    const auto addObject = [&](LabelCollector::View& view, const osgUtil::RenderLeaf& leaf)
    {
        const std::uint32_t object = view.find(
            *leaf._drawable, leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd());
        objects.emplace_back(&leaf, object);
        if (auto scale = view.scaleOf(object))
            _scales.emplace(&leaf, std::move(scale));
    };
    {
        LabelCollector::View view(*_resources->collector, group, *visitor.getModelViewMatrix());
        for (const osgUtil::RenderLeaf* leaf : leaves)
        {
            const osg::Drawable& drawable = *leaf->_drawable;
            if (auto* run = dynamic_cast<const PrimitiveRun*>(&drawable))
                addNumber(*leaf, _resources->batches.recordBaseOf(*run));
            else if (ChunkMesh::isOne(drawable))
                addNumber(*leaf, _resources->objects.indexOf(1));
            else if (!isPoints(drawable))
                addObject(view, *leaf);
        }
    }
    _resources->fitNew();
    for (const auto& [leaf, object] : objects)
        addNumber(*leaf, object ? _resources->objects.indexOf(object) : 0);
}

void LabelPass::addNumber(const osgUtil::RenderLeaf& leaf, std::uint32_t number)
{
    if (number)
        _objects.emplace(&leaf, number);
}

/// Mirrors and other pictures in the view are drawn by cameras of their own.
void LabelPass::takeQuestions(osgUtil::CullVisitor& visitor)
{
    const osg::Camera* camera = visitor.getCurrentRenderBin()->getStage()->getCamera();
    const osgUtil::RenderStage* view = visitor.getRenderStage();
    for (std::size_t i = 0; i < _asked.size(); ++i)
        if (!_asked[i].question)
            _asked[i].question = _picks->of[i].take(camera, !view || view->getCamera() == camera);
}

void LabelPass::answer()
{
    for (std::size_t i = 0; i < _asked.size(); ++i)
        if (_asked[i].question)
            _picks->of[i].answer({_asked[i].identifier, _resources});
    _asked = {};
}

} // namespace osgLabels
