// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/MixedScene.h>
#include <osgMultiRender/Option.h>

#include <map>
#include <string>
#include <vector>

namespace osgMultiRender
{

/// One setting of a MixedScene as text.
using MixOption = Option<MixedScene>;

/// All of them, in the order in which they are set.
OSGMULTIRENDER_EXPORT const std::vector<MixOption>& mixOptions();

/// Sets several in the order of the table, so that renderings are there before what speaks of them.
/// Returns false and fills `error` with one line about the first that is wrong.
OSGMULTIRENDER_EXPORT bool setMixOptions(MixedScene& scene,
                                         const std::map<std::string, std::string>& settings,
                                         std::string& error);

/// Numbers separated by commas or spaces; "inf" is infinite. False if anything else is there.
bool parseNumbers(const std::string& text, std::vector<double>& numbers);

/// One to four numbers: what is missing is the last one but dr2 and dr3, which are infinite.
/// Returns "", or why they are no range.
std::string makeRange(const std::vector<double>& numbers, MixRange& range);

} // namespace osgMultiRender
