// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/LabelSettings.h>

#include <osgMultiRender/Option.h>

#include <string>
#include <vector>

namespace osgLabels
{

/// One setting of a LabelScene as text.
using LabelOption = osgMultiRender::Option<LabelSettings>;

/// All of them.
OSGLABELS_EXPORT const std::vector<LabelOption>& labelOptions();

/// Sets one by its name. Returns false and fills `error` with one line that says what may be said.
OSGLABELS_EXPORT bool setLabelOption(LabelSettings& settings, const std::string& name,
                                     const std::string& text, std::string& error);

/// All that differ from the defaults: "size=0.3,ink='#ff0000'"; empty for none.
OSGLABELS_EXPORT std::string formatLabelOptions(const LabelSettings& settings);

/// The reverse; settings that are not said keep their values. Returns a line for each that is
/// unknown or wrong, which does not count; where the text as a whole is broken none does.
OSGLABELS_EXPORT std::vector<std::string> parseLabelOptions(LabelSettings& settings,
                                                            const std::string& text);

} // namespace osgLabels
