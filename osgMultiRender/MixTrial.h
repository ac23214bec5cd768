// SPDX-License-Identifier: MIT
// Whether a context takes a program. Not installed.
#pragma once

#include <osgMultiRender/Merger.h>

#include <osg/State>

#include <optional>
#include <string>

namespace osgMultiRender
{

/// Compiles and links the two texts and forgets them: "" or what the driver says, with the
/// renderings' own files and lines. The context is current. OSG does not hear of it, so that it
/// does not warn of what its user has yet to be told.
std::string tryProgram(const Merged& merged, osg::State& state);

/// What the context allows to one program, less what the mix itself needs.
MergeLimits limitsOf(osg::State& state, const std::optional<MergeLimits>& most);

} // namespace osgMultiRender
