// SPDX-License-Identifier: MIT
// The cull half of SurfaceFrame: leaves into the private stage, proxies into the view's.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/WithheldLights.h>

#include <osg/Geometry>
#include <osgUtil/PositionalStateContainer>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

/// Stands in a bin of the view for leaves of the private stage.
///
/// Draws the leaf number `single` of a bin, or the whole bin. Counts as one dynamic leaf if any
/// that it stands for is dynamic, and the leaves themselves are drawn without counting: so the
/// update may go on exactly when the last pass has been drawn, however many passes there are.
class ProxyLeaf : public osgUtil::RenderLeaf
{
public:
    static constexpr std::size_t All = ~std::size_t(0);

    ProxyLeaf(SurfaceFrame& frame, std::size_t bin, std::size_t single, osg::Drawable* drawable,
              const osgUtil::RenderLeaf& like)
        : osgUtil::RenderLeaf(drawable, like._projection.get(), like._modelview.get()),
          _frame(&frame), _bin(bin), _single(single)
    {
        if (single != All)
        {
            _depth = like._depth;
            _traversalOrderNumber = like._traversalOrderNumber;
            _dynamic = like._dynamic;
        }
        else
            for (const osgUtil::RenderLeaf* leaf : frame.getLeaves(bin))
                _dynamic = _dynamic || leaf->_dynamic;
        _dynamic = _dynamic || frame.isDynamic();
    }

    void render(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf* previous) override
    {
        osg::State& state = *renderInfo.getState();
        if (state.getAbortRendering())
            return;
        if (previous)
            osgUtil::StateGraph::moveToRootStateGraph(state, previous->_parent->_parent);
        if (_single == All)
            _frame->drawBin(renderInfo, _bin);
        else
            _frame->drawLeaf(renderInfo, _bin, _single);
        _frame->proxyDrawn(renderInfo);
        _frame = nullptr; // the leaf may be kept longer
        // The next leaf starts from our StateGraph.
        osgUtil::StateGraph::moveStateGraph(state, nullptr, _parent->_parent);
        if (_dynamic)
            state.decrementDynamicObjectCount();
    }

private:
    osg::ref_ptr<SurfaceFrame> _frame;
    std::size_t _bin;
    std::size_t _single;
};

/// What viewer statistics see of a bin: the primitives of all its leaves.
class BinDrawable : public osg::Drawable
{
public:
    BinDrawable(SurfaceFrame& frame, std::size_t bin) : _frame(&frame), _bin(bin) {}
    bool supports(const osg::PrimitiveFunctor&) const override { return true; }
    void accept(osg::PrimitiveFunctor& functor) const override
    {
        osg::ref_ptr<SurfaceFrame> frame;
        if (_frame.lock(frame)) // not drawn yet
            for (const osgUtil::RenderLeaf* leaf : frame->getLeaves(_bin))
                leaf->_drawable->accept(functor);
    }

private:
    osg::observer_ptr<SurfaceFrame> _frame;
    std::size_t _bin;
};

/// The StateSet of the leaf's path that asked for the bin, or null.
const osg::StateSet* askedForBin(const osgUtil::RenderLeaf& leaf, int number)
{
    for (const osgUtil::StateGraph* graph = leaf._parent; graph; graph = graph->_parent)
    {
        const osg::StateSet* stateSet = graph->getStateSet();
        if (stateSet && stateSet->useRenderBinDetails() && stateSet->getBinNumber() == number)
            return stateSet;
    }
    return nullptr;
}

const osgUtil::RenderLeaf* anyLeafOf(const osgUtil::RenderBin& bin)
{
    for (const osgUtil::StateGraph* graph :
         const_cast<osgUtil::RenderBin&>(bin).getStateGraphList())
        if (!graph->_leaves.empty())
            return graph->_leaves.front().get();
    for (const auto& [number, inner] : const_cast<osgUtil::RenderBin&>(bin).getRenderBinList())
        if (const osgUtil::RenderLeaf* leaf = anyLeafOf(*inner))
            return leaf;
    return nullptr;
}

bool isOrdered(const osgUtil::RenderBin& bin)
{
    return bin.getSortMode() != osgUtil::RenderBin::SORT_BY_STATE &&
           bin.getSortMode() != osgUtil::RenderBin::SORT_BY_STATE_THEN_FRONT_TO_BACK;
}

} // namespace

SurfaceFrame::SurfaceFrame(SurfaceGroup& group, osgUtil::RenderBin& bin,
                           osgUtil::RenderStage& stage)
    : osg::Referenced(true), _group(&group), _bin(&bin), _stage(bin.getStage()), _private(&stage)
{
    _passes.push_back({&group, group.createPass()});
    _open.push_back(0);
    // Cameras nested in the subgraph take these from the stage that they find.
    _private->setPositionalStateContainer(_stage->getPositionalStateContainer());
    _private->setInheritedPositionalStateContainer(_stage->getInheritedPositionalStateContainer());
    _private->setInheritedPositionalStateContainerMatrix(
        _stage->getInheritedPositionalStateContainerMatrix());
    _private->setViewport(_stage->getViewport());
    _private->setInitialViewMatrix(_stage->getInitialViewMatrix());
    _private->setDrawBuffer(_stage->getDrawBuffer(), _stage->getDrawBufferApplyMask());
    _private->setReadBuffer(_stage->getReadBuffer(), _stage->getReadBufferApplyMask());
    _private->setClearMask(_stage->getClearMask());
    _private->setClearColor(_stage->getClearColor());
    _private->setClearDepth(_stage->getClearDepth());
    _private->setClearStencil(_stage->getClearStencil());
    _private->setClearAccum(_stage->getClearAccum());
    _private->setColorMask(_stage->getColorMask());
    _private->setCamera(_stage->getCamera());
}

SurfaceFrame::~SurfaceFrame() = default;

SurfaceFrame::Nested SurfaceFrame::enter(SurfaceGroup& group)
{
    const osg::StateSet* scope = group.nthStateSet(group._nested, _entered[&group]++);
    const auto known = std::find_if(_passes.begin(), _passes.end(),
                                    [&](const Pass& pass) { return pass.group == &group; });
    auto place = std::uint16_t(known - _passes.begin());
    const bool isNew = known == _passes.end();
    if (isNew)
        _passes.push_back({&group, group.createPass()});
    const bool isCovered =
        std::any_of(_open.begin(), _open.end(),
                    [&](std::uint16_t open)
                    { return open != NoPass && _passes[open].role() == _passes[place].role(); });
    if (isCovered || _passes.size() > NoPass)
    {
        if (isNew)
            _passes.pop_back();
        place = NoPass;
    }
    else
        _scopes.emplace(scope, place);
    _open.push_back(place);
    return {scope, place == NoPass ? nullptr : _passes[place].pass.get()};
}

bool SurfaceFrame::isDynamic() const
{
    return std::any_of(_passes.begin(), _passes.end(),
                       [](const Pass& pass) { return pass.pass->isDynamic(); });
}

std::vector<osg::ref_ptr<osgUtil::RenderLeaf>>
SurfaceFrame::insertProxies(osgUtil::StateGraph& graph)
{
    for (const auto& [order, stage] : _private->getPreRenderList())
        _stage->addPreRenderStage(stage.get(), order);
    for (const auto& [order, stage] : _private->getPostRenderList())
        _stage->addPostRenderStage(stage.get(), order);
    // What ClearNodes in the subgraph set.
    _stage->setClearColor(_private->getClearColor());
    _stage->setClearMask(_private->getClearMask());
    mirror(graph, *_private, *_bin);
    return std::move(_made);
}

void SurfaceFrame::addProxy(osgUtil::StateGraph& graph, osgUtil::RenderLeaf* proxy)
{
    graph.addLeaf(proxy);
    _made.push_back(proxy);
    ++_proxies;
}

void SurfaceFrame::mirrorLeaves(osgUtil::StateGraph& proxies, osgUtil::RenderBin& from,
                                osgUtil::RenderBin& to)
{
    std::vector<osgUtil::RenderLeaf*> leaves;
    for (osgUtil::StateGraph* graph : from.getStateGraphList())
        for (const auto& leaf : graph->_leaves)
            leaves.push_back(leaf.get());
    if (leaves.empty())
        return;
    _bins.push_back(std::move(leaves));
    const std::size_t bin = _bins.size() - 1;
    const auto* stateSet = _group->getProxyStateSet(bin);
    osgUtil::StateGraph* graph = proxies.find_or_insert(stateSet);
    if (graph->leaves_empty())
        to.addStateGraph(graph);
    if (isOrdered(to))
        for (std::size_t i = 0; i < _bins[bin].size(); ++i)
            addProxy(*graph,
                     new ProxyLeaf(*this, bin, i, _bins[bin][i]->_drawable.get(), *_bins[bin][i]));
    else
        addProxy(*graph, new ProxyLeaf(*this, bin, ProxyLeaf::All, new BinDrawable(*this, bin),
                                       *_bins[bin].front()));
    _isOrdered.push_back(isOrdered(to));
}

/// In the order in which bins are drawn: those with negative numbers come before the leaves.
void SurfaceFrame::mirror(osgUtil::StateGraph& proxies, osgUtil::RenderBin& from,
                          osgUtil::RenderBin& to)
{
    const auto mirrorInner = [&](int number, osgUtil::RenderBin& inner)
    {
        const osgUtil::RenderLeaf* leaf = anyLeafOf(inner);
        if (!leaf)
            return;
        const osg::StateSet* asked = askedForBin(*leaf, number);
        // A bin that does not nest belongs to the stage of the view, wherever the group lies.
        const bool escapes = &from == _private.get() && asked && !asked->getNestRenderBins();
        osgUtil::RenderBin& outer = escapes ? *_stage : to;
        mirror(proxies, inner,
               *outer.find_or_insert(number, asked ? asked->getBinName() : "RenderBin"));
    };
    const auto& bins = from.getRenderBinList();
    const auto later = bins.lower_bound(0);
    for (auto bin = bins.begin(); bin != later; ++bin)
        mirrorInner(bin->first, *bin->second);
    mirrorLeaves(proxies, from, to);
    for (auto bin = later; bin != bins.end(); ++bin)
        mirrorInner(bin->first, *bin->second);
}

void SurfaceFrame::forEachLight(
    const std::function<void(const osg::Light&, const osg::Matrix*, bool isHeadlight)>& f) const
{
    const auto visit = [&f](osgUtil::PositionalStateContainer* container, const osg::Matrix* post)
    {
        if (!container)
            return;
        const auto give = [&](const osg::Light& light, const osg::RefMatrix* matrix)
        {
            if (!post)
                return f(light, matrix, !matrix);
            const osg::Matrix product = matrix ? *matrix * *post : *post;
            f(light, &product, !matrix);
        };
        for (const auto& [attribute, matrix] : container->getAttrMatrixList())
        {
            const osg::StateAttribute* any = attribute.get();
            if (auto* light = dynamic_cast<const osg::Light*>(any))
                give(*light, matrix.get());
            else if (auto* withheld = dynamic_cast<const WithheldLights*>(any))
                for (const WithheldLights::Positioned& entry : withheld->getLights())
                    give(*entry.light, entry.matrix.get());
        }
    };
    visit(_stage->getInheritedPositionalStateContainer(),
          &_stage->getInheritedPositionalStateContainerMatrix());
    visit(_stage->getPositionalStateContainer(), nullptr);
}

osg::BoundingBoxd SurfaceFrame::getBounds(const osg::Matrixd& matrix, bool& unbounded) const
{
    // Leaves under one transform share its matrix: their boxes are joined before they are
    // transformed.
    std::unordered_map<const osg::RefMatrix*, osg::BoundingBox> local;
    unbounded = false;
    for (const auto& bin : _bins)
        for (const osgUtil::RenderLeaf* leaf : bin)
        {
            const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
            const osg::Geometry* geometry = leaf->_drawable->asGeometry();
            if (geometry &&
                (!geometry->getVertexArray() || !geometry->getVertexArray()->getNumElements()))
                continue; // draws nothing
            if (box.valid())
                local[leaf->_modelview.get()].expandBy(box);
            else
                unbounded = true;
        }
    osg::BoundingBoxd bounds;
    for (const auto& [modelview, box] : local)
    {
        const osg::Matrixd toFrame = modelview ? osg::Matrixd(*modelview) * matrix : matrix;
        for (unsigned int corner = 0; corner < 8; ++corner)
            bounds.expandBy(osg::Vec3d(box.corner(corner)) * toFrame);
    }
    return bounds;
}

} // namespace osgMultiRender
