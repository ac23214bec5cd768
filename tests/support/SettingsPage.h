// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace support
{

/// A row of a table of settings that users read.
struct DocumentedSetting
{
    std::string name, values; ///< As SceneOption and LabelOption say them.
    std::string byDefault;    ///< Empty: the row need not say it.
};

/// What the section under `heading` ("# Settings of shadows") of a page of docs lacks: settings
/// without a row, rows without a setting, values, bounds and defaults that are not said.
std::vector<std::string> undocumented(const std::string& page, const std::string& heading,
                                      const std::vector<DocumentedSetting>& settings);

} // namespace support
