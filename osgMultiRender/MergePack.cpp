// SPDX-License-Identifier: MIT
// Varyings of all renderings in as few vectors as they fit in.
#include <osgMultiRender/MergeProgram.h>

#include <algorithm>

namespace osgMultiRender
{

std::vector<MergeVector> packVaryings(const std::vector<MergeProgram*>& programs, bool share,
                                      MergeStatistics& statistics)
{
    std::vector<MergeVarying*> all;
    for (MergeProgram* program : programs)
    {
        for (MergeVarying& one : program->varyings)
        {
            one.sharedWith = nullptr;
            all.push_back(&one);
        }
    }
    // Large ones first: what is left of four components fits small ones.
    std::stable_sort(all.begin(), all.end(), [](const MergeVarying* a, const MergeVarying* b)
                     { return a->components > b->components; });
    std::vector<MergeVector> vectors;
    statistics.sharedVaryings = 0;
    statistics.varyingComponents = 0;
    std::map<std::string, const MergeVarying*> byValue;
    for (MergeVarying* one : all)
    {
        const std::string key = one->base + std::to_string(one->components) + one->interpolation +
                                " " + one->value;
        if (share && !one->value.empty())
        {
            const auto [found, added] = byValue.emplace(key, one);
            if (!added)
            {
                one->slot = found->second->slot;
                one->offset = found->second->offset;
                one->sharedWith = found->second;
                ++statistics.sharedVaryings;
                continue;
            }
        }
        std::size_t slot = 0;
        while (slot < vectors.size() &&
               (vectors[slot].base != one->base ||
                vectors[slot].interpolation != one->interpolation ||
                vectors[slot].used + one->components > 4))
        {
            ++slot;
        }
        if (slot == vectors.size())
        {
            vectors.push_back({one->base, one->interpolation, 0, ""});
            vectors.back().name = "osgmr_varying" + std::to_string(slot);
        }
        one->slot = slot;
        one->offset = vectors[slot].used;
        vectors[slot].used += one->components;
        statistics.varyingComponents += one->components;
    }
    statistics.varyingVectors = static_cast<int>(vectors.size());
    return vectors;
}

} // namespace osgMultiRender
