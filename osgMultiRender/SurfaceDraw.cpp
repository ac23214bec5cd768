// SPDX-License-Identifier: MIT
// The draw half of SurfaceFrame; SurfaceFrame.cpp resolves.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/PassState.h>
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
    for (std::size_t i = 0, end = 0; i < count; i = end)
    {
        for (end = i + 1; end < count && items[end].passes == items[i].passes;)
            ++end;
        drawRun(renderInfo, items + i, end - i);
    }
}

/// Leaves of the same passes.
void SurfaceFrame::drawRun(osg::RenderInfo& renderInfo, const SurfaceItem* items, std::size_t count)
{
    osg::State& state = *renderInfo.getState();
    const osg::StateSet* under = mergeUnder(items->passes);
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
const osg::StateSet* SurfaceFrame::mergeUnder(const SurfacePasses& passes)
{
    std::vector<const osg::StateSet*> stateSets;
    for (const std::uint16_t place : passes)
        if (place != NoPass)
            if (const osg::StateSet* stateSet = _passes[place].pass->startRun())
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

void SurfaceFrame::drawSelected(osg::RenderInfo& renderInfo, const StateFor& over,
                                const std::function<bool(const SurfaceItem&)>& select)
{
    osg::State& state = *renderInfo.getState();
    std::map<std::uint64_t, std::vector<SurfaceItem>> byInstance; // 0: without a VertexSnippet
    forEachItem(
        [&](const SurfaceItem& item)
        {
            if (item.variant && select(item))
                byInstance[item.variant->getKey().instance].push_back(item);
        });
    for (auto& [content, items] : byInstance)
    {
        const osg::StateSet& stateSet = over(items.front().instance);
        if (stateSet.getAttribute(osg::StateAttribute::PROGRAM))
            for (SurfaceItem& item : items)
                item.variant = nullptr;
        state.pushStateSet(&stateSet);
        draw(renderInfo, items.data(), items.size());
        state.popStateSet();
    }
}

std::size_t SurfaceFrame::drawAs(osg::RenderInfo& renderInfo, const osg::StateSet& over,
                                 const std::function<bool(const SurfaceItem&, SurfaceKey&)>& rekey)
{
    std::vector<SurfaceItem> items;
    std::size_t refused = 0;
    forEachItem(
        [&](const SurfaceItem& item)
        {
            const auto surface = _surfaces.find({item.leaf->_parent, item.look});
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
            items.back().variant = variantOf(key, surface->second);
        });
    const PassState pass(*renderInfo.getState(), over);
    draw(renderInfo, items.data(), items.size());
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
            for (std::size_t role = 0; role < item.passes.size(); ++role)
                if (item.passes[role] != NoPass && item.wants(role))
                    _passes[item.passes[role]].pass->apply(renderInfo, *variant, leaf,
                                                           item.numbers[role]);
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
    OSG_WARN << _group->getCompoundClassName() << ": program '" << name
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
    for (const SurfaceVariant* variant : _failedOutputs)
    {
        ++failed;
        plan.entries.push_back(
            {"output of program '" +
                 (variant->getProgram() ? variant->getProgram()->getName() : std::string()) + "'",
             PlanEntry::Decision::Dropped,
             "the program does not compile or link with it; its surfaces keep "
             "their look"});
    }
    if (isEmpty())
        plan.entries.push_back(
            {"everything", PlanEntry::Decision::Dropped, "nothing of it is in view"});
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
        own.kit = pass.group->getCompoundClassName();
        if (!isEmpty())
            pass.pass->fillPlan(own);
        pass.group->setPlan(_stage->getCamera(), std::move(own));
    }
}

} // namespace osgMultiRender
