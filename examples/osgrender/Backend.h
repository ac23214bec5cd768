// SPDX-License-Identifier: MIT
#pragma once

#include "Arguments.h"

#include <string>

namespace osgrender
{

/// Lets OSG find the suite's plugins beside this program, in the build tree and installed.
void addPluginFolders();

/// Loads the windowing plugin and returns which one it is, never Auto.
///
/// OSMesa has to come before libGL in the symbol order, so for it the process replaces itself by
/// itself with LD_PRELOAD set, and this does not return. Call it before any graphics context and
/// before any model is read (Coin takes its offscreen context from the plugin). On failure `error`
/// is filled.
Backend chooseBackend(Backend wanted, char** argv, std::string& error);

} // namespace osgrender
