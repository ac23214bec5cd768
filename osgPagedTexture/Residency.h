// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// A texture that wants memory.
struct ResidencyWish
{
    static constexpr double None = -1.0;

    /// Bytes of the levels from each one on: bytes[0] is all of it. Outlives the call.
    const std::uint64_t* bytes = nullptr;
    int levels = 0; ///< Entries of `bytes`; 0: a texture that can't be loaded.
    /// The finest level that what is in view uses, with a fraction; None: nothing in view uses it.
    double need = None;
    double soon = None;         ///< As `need`, for what will be in view.
    int resident = -1;          ///< Finest level that is there; -1: none.
    std::uint32_t lastUsed = 0; ///< Frame in which it was last in view.
};

/// Who gets what.
struct ResidencyPlan
{
    std::vector<int> first;  ///< Finest level of each texture; -1: nothing of it.
    std::uint64_t bytes = 0; ///< Of all of them together, at most the budget.
    double bias = 0.0;       ///< Levels by which what is in view is coarser than it needs.
    bool isWhole = false;    ///< All textures fit at their full size: nothing has to be paged.
};

/// Divides `budget` bytes. What is in view comes first, coarser by the same number of levels for
/// all where it does not fit, so that the least needed goes first; then what will be in view; then
/// what is there already, last used first. A texture that is there keeps a level that is just not
/// needed, so that nothing goes back and forth. The same wishes give the same plan. `others`: bytes
/// of textures that wish nothing and have nothing; all it does is to keep the plan from being
/// whole.
OSGPAGEDTEXTURE_EXPORT ResidencyPlan planResidency(const std::vector<ResidencyWish>& wishes,
                                                   std::uint64_t budget, std::uint64_t others = 0);

} // namespace osgPagedTexture
