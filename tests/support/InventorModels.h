// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace support
{

/// Absolute paths of all models of Debian's inventor-data, sorted; empty where it is not installed.
std::vector<std::string> inventorModels();

/// The path of one of them, named from the folder of models: "chess/king.iv".
std::string inventorModel(const std::string& name);

} // namespace support
