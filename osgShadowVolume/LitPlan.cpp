// SPDX-License-Identifier: MIT
// What LitPass says of a frame.
#include <osgShadowVolume/LitPass.h>

#include <algorithm>

namespace osgShadowVolume
{

using osgMultiRender::PlanEntry;

namespace
{

constexpr std::size_t maxPlanned = 64; ///< Lights that a plan names one by one.

std::string subjectOf(const EyeLight& light)
{
    static const char* const types[] = {"directional", "point", "spot", "directional spot"};
    std::string subject = "light " + std::to_string(light.number);
    if (!light.name.empty())
        subject += " '" + light.name + "'";
    return subject + " (" + types[light.type] + ")";
}

} // namespace

void LitPass::fillPlan(osgMultiRender::Plan& plan) const
{
    std::size_t drawn = 0, dropped = _dropped.size(), named = 0;
    const auto add =
        [&](const EyeLight& light, PlanEntry::Decision decision, const std::string& reason)
    {
        if (named++ < maxPlanned)
            plan.entries.push_back({subjectOf(light), decision, reason});
    };
    for (const Dropped& light : _dropped)
        add(light.light, PlanEntry::Decision::Dropped, light.reason);
    for (std::size_t i = 0; i < _lights.size(); ++i)
    {
        if (_used[i])
        {
            ++drawn;
            if (shadowIndexOf(i) >= 0.0f)
                add(_lights[i], PlanEntry::Decision::Drawn, _shadows->describe(i));
            else
                add(_lights[i], PlanEntry::Decision::Folded,
                    "in the one pass of all unshadowed lights" +
                        (_shadows ? ": " + _shadows->getDecision(i).reason : std::string()));
        }
        else
        {
            ++dropped;
            add(_lights[i], PlanEntry::Decision::Dropped,
                "no drawable in view has it on and in reach");
        }
    }
    if (named > maxPlanned)
        plan.entries.push_back({std::to_string(named - maxPlanned) + " more lights",
                                PlanEntry::Decision::Folded, "see the counts"});
    plan.counts["lights.drawn"] = static_cast<double>(drawn);
    plan.counts["lights.dropped"] = static_cast<double>(dropped);
    plan.counts["lights.grids"] = static_cast<double>(std::count_if(
        _sets.begin(), _sets.end(), [](const auto& s) { return s.second.grid.has_value(); }));
    if (_shadows)
        _shadows->fillPlan(plan);
    if (_mirrors)
        _mirrors->fillPlan(plan);
    if (_settings.show == Show::ILLUMINANCE)
        plan.counts["illuminance.maximum"] = _measures.maximum;
    plan.counts["textureBytes"] =
        _textures ? double(_textures->lights->getImage()->getTotalSizeInBytes() +
                           _textures->lists->getImage()->getTotalSizeInBytes())
                  : 0.0;
}

} // namespace osgShadowVolume
