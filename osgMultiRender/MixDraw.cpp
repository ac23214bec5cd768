// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixDraw.h>

#include <osg/BlendFunc>

namespace osgMultiRender
{

void MixResources::setFramePlan(const osg::Camera* camera, Plan plan)
{
    const osg::observer_ptr<const osg::Camera> none;
    std::lock_guard<std::mutex> lock(mutex);
    for (auto view = framePlans.begin(); view != framePlans.end();)
        view = view->first != none && !view->first.valid() ? framePlans.erase(view) : ++view;
    framePlans[camera] = std::move(plan);
}

MixDraw::MixDraw(std::shared_ptr<MixResources> resources,
                 std::shared_ptr<const MixSnapshot> snapshot)
    : _resources(std::move(resources)), _snapshot(std::move(snapshot))
{
}

void MixDraw::begin(osg::State& state, const osg::Matrixd& keysToEye, GetParts getParts)
{
    _getParts = std::move(getParts);
    _contextID = state.getContextID();
    const std::shared_ptr<const MixSnapshot> wanted = _snapshot;
    _snapshot = _resources->programs.withoutBroken(wanted, state);
    for (std::size_t i = 0; i < _snapshot->slots.size(); ++i)
        if (_snapshot->slots[i].id != wanted->slots[i].id)
            _replaced.push_back(i);
    _frame = _resources->programs.begin(_snapshot, state, [this] { return getShares(); });
    _weights = weightsOf(*_snapshot, _frame.isShown);
    {
        std::lock_guard<std::mutex> lock(_resources->mutex);
        auto& free = _resources->free[_contextID];
        if (!free.empty())
        {
            _state = free.back();
            free.pop_back();
        }
    }
    if (!_state)
        _state = new MixState(MixUnit);
    _state->update(*_snapshot->points, _weights, keysToEye);
    osg::StateSet& stateSet = *_state->getStateSet();
    const auto mode = osg::StateAttribute::OVERRIDE;
    if (_snapshot->isTransparent)
        stateSet.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA),
                                      mode | osg::StateAttribute::ON);
    else
        stateSet.removeAttribute(osg::StateAttribute::BLENDFUNC);
}

void MixDraw::end()
{
    if (!_state)
        return;
    std::lock_guard<std::mutex> lock(_resources->mutex);
    _resources->free[_contextID].push_back(_state);
    _state = nullptr;
    _getParts = nullptr;
}

/// Renderings that are not shown have no range, so that the rules do not count them.
MixWeights MixDraw::weightsOf(const MixSnapshot& snapshot, const std::vector<bool>& isShown) const
{
    std::vector<MixRange> ranges;
    for (std::size_t i = 0; i < snapshot.slots.size(); ++i)
    {
        constexpr double never = std::numeric_limits<double>::infinity();
        ranges.push_back(isShown[i] ? snapshot.slots[i].range
                                    : MixRange{never, never, never, never});
    }
    MixRules rules = snapshot.rules;
    if (rules.base >= int(ranges.size()) || (rules.base >= 0 && !isShown[rules.base]))
        rules.base = -1;
    return MixWeights(ranges, rules);
}

MixSlotShares MixDraw::getShares() const
{
    std::vector<bool> isThere;
    for (const MixSlot& slot : _snapshot->slots)
        isThere.push_back(slot.rendering != nullptr);
    return sharesOf(*_snapshot->points, weightsOf(*_snapshot, isThere),
                    _getParts ? _getParts() : std::vector<MixPart>());
}

void MixDraw::fillPlan(Plan& plan) const
{
    for (const auto& [slot, why] : _frame.leftOut)
        plan.entries.push_back({"rendering " + std::to_string(slot) + " '" +
                                    _snapshot->slots[slot].rendering->name + "'",
                                PlanEntry::Decision::Dropped, why});
    for (const std::size_t slot : _replaced)
        plan.entries.push_back({"rendering " + std::to_string(slot) + " '" +
                                    _snapshot->slots[slot].rendering->name + "'",
                                PlanEntry::Decision::Drawn,
                                "as it was before a change that can't be used"});
    if (_frame.all)
        for (const MergeMessage& message : _frame.all->getMerged().messages)
            if (message.severity != MergeSeverity::Error)
                plan.entries.push_back(
                    {"merged program", PlanEntry::Decision::Drawn, message.text});
    const MixPrograms::Counts counts = _resources->programs.getCounts();
    plan.counts["mix.programs"] = counts.kept;
    plan.counts["mix.programs.started"] = counts.started;
    plan.counts["mix.programs.merged"] = counts.merged;
    plan.counts["mix.programs.linked"] = counts.linked;
    plan.counts["mix.programs.tried"] = counts.tried;
    plan.counts["mix.programs.evicted"] = counts.evicted;
    plan.counts["mix.mergeMilliseconds"] = counts.mergeMilliseconds;
    plan.counts["mix.linkMilliseconds"] = counts.linkMilliseconds;
    plan.counts["mix.keyPoints"] = static_cast<double>(_snapshot->points->getNumPoints());
}

} // namespace osgMultiRender
