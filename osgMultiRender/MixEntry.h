// SPDX-License-Identifier: MIT
// The program of a rendering in a mix file. Not installed.
#pragma once

#include <osgMultiRender/Rendering.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace osgMultiRender
{

using MixJson = nlohmann::ordered_json;

/// Whether the key of an entry is one of its program.
bool isMixProgramKey(const std::string& key);

/// Makes the rendering that an entry names, as a file or built-in, or has in full. `pathOf` says
/// where its files lie. Returns "", or what is wrong, to be put behind the entry's place.
std::string readMixProgram(const MixJson& entry,
                           const std::function<std::string(const std::string&)>& pathOf,
                           Rendering& rendering);

/// Writes it so that readMixProgram() makes the same: by name, by file, else in full. Warns of what
/// a mix file can't hold.
void formatMixProgram(const Rendering& rendering, MixJson& entry);

} // namespace osgMultiRender
