// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/LabelSettings.h>

#include <functional>
#include <string>
#include <vector>

namespace osgLabels
{

/// One setting of a LabelScene as text, as pseudo-loaders and files say it.
struct LabelOption
{
    std::string name;   ///< "size".
    std::string values; ///< What may be said: "auto|<#rrggbb>", "<0.05..0.9>".
    std::string help;   ///< One sentence.
    /// Sets it; returns "", or why the text is wrong, and then sets nothing.
    std::function<std::string(LabelSettings&, const std::string& text)> parse;
    /// The text that parse() would take for the value that the settings have.
    std::function<std::string(const LabelSettings&)> format;
};

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
