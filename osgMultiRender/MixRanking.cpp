// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixRanking.h>

#include <osg/Notify>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

/// For less it is not worth a merge.
constexpr double MuchMore = 1.1;

/// Whether one that is left out has got more weight than one that is shown. Not if it had more
/// already: then the latter does not count for the limit.
bool isOutweighed(const MixProgram& all, const MixSlotShares& shares)
{
    const auto shareIn = [](const MixSlotShares& of, std::uint16_t slot)
    { return slot < of.size() ? of[slot] : 1.0; };
    for (const MixSet::Member& out : all.getSet().members)
        for (const MixSet::Member& in : all.getSet().members)
            if (!all.covers(out.slot) && all.covers(in.slot) &&
                shareIn(all.shares, out.slot) <= shareIn(all.shares, in.slot) &&
                shareIn(shares, out.slot) > MuchMore * shareIn(shares, in.slot))
                return true;
    return false;
}

} // namespace

std::optional<MixSlotShares> MixRanking::look(const MixProgram& all, unsigned int frame,
                                              unsigned int interval, const GetMixShares& getShares)
{
    const std::vector<MixSet::Member>& members = all.getSet().members;
    if (std::all_of(members.begin(), members.end(),
                    [&](const MixSet::Member& member) { return all.covers(member.slot); }))
        return std::nullopt;
    _interval = std::max(_interval, interval);
    if (frame >= _looked && frame - _looked < _interval)
        return std::nullopt;
    _looked = frame;
    MixSlotShares shares = getShares();
    if (!isOutweighed(all, shares))
        return std::nullopt;
    _interval = std::min(2 * std::max(_interval, 1u), 100000u);
    return shares;
}

void MixRanking::warn(const MixProgram& program)
{
    const std::vector<MixSet::Member>& members = program.getSet().members;
    for (const MergeMessage& message : program.getMerged().messages)
        if (message.severity == MergeSeverity::Error && message.rendering < members.size() &&
            _warned.emplace(members[message.rendering].id, message.text).second)
            OSG_WARN << "osgMultiRender::MixedScene: " << message.text
                     << "; it has the least weight: give it more, or remove renderings"
                     << std::endl;
}

} // namespace osgMultiRender
