// SPDX-License-Identifier: MIT
#pragma once

#include "Surface.h"

namespace osgHeadless
{

/// Prints a warning of a plugin, each line once a process: osgviewer asks several times for a
/// window that failed, Coin for each patch.
void reportOnce(const Backend& backend, const std::string& error);

} // namespace osgHeadless
