// SPDX-License-Identifier: MIT
// The draw half of SurfaceFrame; SurfaceFrame.cpp resolves.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/ProgramWrap.h>

#include <osg/GLExtensions>
#include <osg/Notify>
#include <osg/Timer>

#include <algorithm>
#include <functional>

namespace osgMultiRender
{

void SurfaceFrame::draw(osg::RenderInfo& renderInfo, const SurfaceItem* items, std::size_t count)
{
    osg::State& state = *renderInfo.getState();
    if (count == 0)
        return;
    const osg::StateSet* under = mergeUnder();
    if (_withheld)
        state.pushStateSet(_withheld.get());
    if (under)
        state.pushStateSet(under);
    osgUtil::RenderLeaf* previous = nullptr;
    SurfaceVariant* current = nullptr;
    for (std::size_t i = 0; i < count; ++i)
    {
        if (items[i].variant != current)
        {
            if (previous)
                osgUtil::StateGraph::moveToRootStateGraph(state, previous->_parent->_parent);
            previous = nullptr;
            if (current)
                state.popStateSet();
            current = items[i].variant;
            if (current)
                state.pushStateSet(current->getStateSet());
        }
        drawOne(renderInfo, items[i], previous);
        previous = items[i].leaf;
    }
    if (previous)
        osgUtil::StateGraph::moveToRootStateGraph(state, previous->_parent->_parent);
    if (current)
        state.popStateSet();
    if (under)
        state.popStateSet();
    if (_withheld)
        state.popStateSet();
}

/// What the passes want below the variants, as one StateSet: pushed apart, a leaf that follows
/// without a change of state would not get what the other one has set meanwhile.
const osg::StateSet* SurfaceFrame::mergeUnder()
{
    std::vector<const osg::StateSet*> stateSets;
    for (const Pass& pass : _passes)
        if (const osg::StateSet* stateSet = pass.pass->startRun())
            stateSets.push_back(stateSet);
    if (stateSets.size() < 2)
        return stateSets.empty() ? nullptr : stateSets.front();
    if (stateSets != _mergedFrom)
    {
        _mergedFrom = stateSets;
        _merged = new osg::StateSet;
        for (const osg::StateSet* stateSet : stateSets)
            _merged->merge(*stateSet);
    }
    return _merged.get();
}

void SurfaceFrame::drawSelected(osg::RenderInfo& renderInfo, const osg::StateSet& over,
                                const std::function<bool(const SurfaceItem&)>& select)
{
    osg::State& state = *renderInfo.getState();
    const bool hasProgram = over.getAttribute(osg::StateAttribute::PROGRAM) != nullptr;
    std::vector<SurfaceItem> selected, instanced;
    forEachItem(
        [&](const SurfaceItem& item)
        {
            if (!item.variant || !select(item))
                return;
            // What is drawn many times has its places from a program with its VertexSnippet.
            const bool keepsProgram = hasProgram && item.variant->getKey().instance;
            (keepsProgram ? instanced : selected).push_back(item);
            if (hasProgram && !keepsProgram)
                selected.back().variant = nullptr;
        });
    const auto drawUnder = [&](const osg::StateSet& stateSet, const std::vector<SurfaceItem>& items)
    {
        state.pushStateSet(&stateSet);
        draw(renderInfo, items.data(), items.size());
        state.popStateSet();
    };
    drawUnder(over, selected);
    if (instanced.empty())
        return;
    const osg::ref_ptr<osg::StateSet> withoutProgram = new osg::StateSet(over);
    withoutProgram->removeAttribute(osg::StateAttribute::PROGRAM);
    drawUnder(*withoutProgram, instanced);
}

std::size_t SurfaceFrame::drawAs(osg::RenderInfo& renderInfo, const osg::StateSet& over,
                                 const std::function<bool(const SurfaceItem&, SurfaceKey&)>& rekey)
{
    std::vector<SurfaceItem> items;
    std::size_t refused = 0;
    forEachItem(
        [&](const SurfaceItem& item)
        {
            const auto surface = _surfaces.find(item.leaf->_parent);
            if (surface == _surfaces.end())
                return;
            SurfaceKey key = item.variant ? item.variant->getKey() : SurfaceKey();
            if (!item.variant)
                key.instance = surface->second.key.instance;
            if (!rekey(item, key))
                return;
            const bool keepsProgram =
                !item.variant && !key.instance && surface->second.state->get(SurfaceState::Program);
            if (keepsProgram || surface->second.state->isProgramProtected())
            {
                ++refused;
                return;
            }
            items.push_back(item);
            items.back().variant =
                variantOf(key, surface->second.program, surface->second.instance);
        });
    std::stable_sort(items.begin(), items.end(),
                     [](const SurfaceItem& a, const SurfaceItem& b)
                     { return std::less<>()(a.variant, b.variant); });
    osg::State& state = *renderInfo.getState();
    state.pushStateSet(&over);
    draw(renderInfo, items.data(), items.size());
    state.popStateSet();
    return refused;
}

void SurfaceFrame::drawOne(osg::RenderInfo& renderInfo, const SurfaceItem& item,
                           osgUtil::RenderLeaf* previous)
{
    osg::State& state = *renderInfo.getState();
    osgUtil::RenderLeaf& leaf = *item.leaf;
    state.applyProjectionMatrix(leaf._projection.get());
    state.applyModelViewMatrix(leaf._modelview.get());

    SurfaceVariant* variant = item.variant;
    const bool first = variant && variant->compileMilliseconds.load() == 0.0;
    const osg::Timer_t start = first ? osg::Timer::instance()->tick() : 0;
    osgUtil::StateGraph* graph = leaf._parent;
    osgUtil::StateGraph::moveStateGraph(state, previous ? previous->_parent->_parent : nullptr,
                                        graph->_parent);
    if (!previous || previous->_parent != graph)
        state.apply(graph->getStateSet());
    if (first)
        variant->compileMilliseconds =
            osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
    if (variant)
    {
        const auto* program = state.getLastAppliedProgramObject();
        if (!program || program->getProgram() != variant->getProgram())
            reportFailure(state, *variant);
        else
            for (const Pass& pass : _passes)
                if (pass.isLight() ? variant->getKey().kit : variant->getKey().output)
                    pass.pass->apply(renderInfo, *variant, leaf,
                                     item.numbers[std::size_t(pass.pass->getRole())]);
    }
    if (state.getUseModelViewAndProjectionUniforms())
        state.applyModelViewAndProjectionUniformsIfRequired();
    leaf._drawable->draw(renderInfo);
}

void SurfaceFrame::reportFailure(osg::State& state, SurfaceVariant& variant)
{
    if (variant.failed.exchange(true))
        return;
    _group->addFailure(_stage->getCamera());
    const std::string& name = variant.getProgram()->getName();
    OSG_WARN << _group->libraryName() << "::" << _group->className() << ": program '" << name
             << "' does not compile or link, its surfaces show the fixed-function look instead:\n"
             << errorsOf(*variant.getProgram(), state) << std::flush;
}

void SurfaceFrame::writePlan(osg::RenderInfo& renderInfo)
{
    Plan plan;
    if (const osg::FrameStamp* stamp = renderInfo.getState()->getFrameStamp())
        plan.frame = stamp->getFrameNumber();
    unsigned int drawn = 0, fixed = 0, failed = 0;
    std::map<SurfaceVariant*, unsigned int> leaves;
    for (const auto& bin : _items)
        for (const SurfaceItem& item : bin)
        {
            ++(item.variant ? drawn : fixed);
            if (item.variant)
                ++leaves[item.variant];
        }
    double compileMilliseconds = 0.0;
    for (const auto& [variant, number] : leaves)
    {
        failed += variant->failed;
        compileMilliseconds += variant->compileMilliseconds;
        plan.entries.push_back({"variant " + toString(variant->getKey()),
                                PlanEntry::Decision::Drawn, std::to_string(number) + " drawables"});
    }
    for (const SurfaceVariant* wrapper : _failedWrappers)
    {
        ++failed;
        plan.entries.push_back({"program '" + wrapper->getProgram()->getName() + "'",
                                PlanEntry::Decision::Dropped,
                                "it does not compile or link; its surfaces show the "
                                "fixed-function look"});
    }
    for (const auto& [reason, number] : _beyond)
        plan.entries.push_back(
            {"fixed function", PlanEntry::Decision::Drawn,
             std::to_string(number) + " drawables keep it because of " + reason});
    plan.counts["leaves.program"] = drawn;
    plan.counts["leaves.fixedFunction"] = fixed;
    plan.counts["drawCalls"] = drawn + fixed;
    plan.counts["passes"] = drawn + fixed ? 1 : 0;
    plan.counts["variants"] = static_cast<double>(leaves.size());
    plan.counts["variants.failed"] = failed;
    std::size_t states = 0;
    for (const auto& [graph, surface] : _surfaces)
        states += !surface.beyond;
    plan.counts["states"] = static_cast<double>(states);
    plan.counts["programs.compiledThisFrame"] = _compiled;
    plan.counts["programs.compileMilliseconds"] = compileMilliseconds;
    for (const Pass& pass : _passes)
    {
        Plan own = plan;
        own.kit = std::string(pass.group->libraryName()) + "::" + pass.group->className();
        pass.pass->fillPlan(own);
        pass.group->setPlan(_stage->getCamera(), std::move(own));
    }
}

} // namespace osgMultiRender
