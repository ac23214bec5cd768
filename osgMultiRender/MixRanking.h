// SPDX-License-Identifier: MIT
// Which renderings a program has where limits do not allow all. Not installed.
#pragma once

#include <osgMultiRender/MixProgram.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace osgMultiRender
{

/// Tells how much each slot counts in the picture of the frame. It takes some milliseconds, and is
/// only asked where it decides something.
using GetMixShares = std::function<MixSlotShares()>;

/// Watches the program of all renderings where limits leave some out of it.
class MixRanking
{
public:
    /// To be called by views that rest; the weights with which the program is to be made anew, when
    /// what is left out counts more than what is shown. Looks every `interval` frames, after
    /// each such program half as often, so that views that differ do not take turns for ever.
    std::optional<MixSlotShares> look(const MixProgram& all, unsigned int frame,
                                      unsigned int interval, const GetMixShares& getShares);
    /// Key points, ranges or rules have changed.
    void reset() { _interval = 0; }

    /// Warns once of each rendering and limit.
    void warn(const MixProgram& program);

private:
    unsigned int _interval = 0; ///< 0: that of the caller.
    unsigned int _looked = 0;   ///< Frame.
    std::set<std::pair<std::uint64_t, std::string>> _warned;
};

} // namespace osgMultiRender
