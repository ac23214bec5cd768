// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace glslSamples
{

/// A fragment stage and what it draws into.
struct Sample
{
    const char* name;
    std::vector<std::string> fragments;                              ///< One text a shader object.
    int targets = 1;                                                 ///< Colour attachments.
    bool integers = false;                                           ///< Attachments are RGBA8UI.
    std::vector<std::pair<const char*, unsigned int>> bindings = {}; ///< glBindFragDataLocation.
};

/// Programs that cover what a fragment stage may write and declare, each with a picture that
/// depends on the varying `uv` (0 to 1).
const std::vector<Sample>& fragmentSamples();

} // namespace glslSamples
