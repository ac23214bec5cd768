// SPDX-License-Identifier: MIT
// The uniforms of a merged program. Not installed.
#pragma once

#include <osgMultiRender/MergeProgram.h>

namespace osgMultiRender
{

/// Components of a built-in type; 0 for others.
int componentsOf(const std::string& type);

/// Lists the uniforms and blocks of all programs, each member of a struct by itself too, and counts
/// what they take. Samplers have the units of their own renderings.
void planUniforms(const std::vector<MergeProgram*>& programs, Merged& merged);

} // namespace osgMultiRender
