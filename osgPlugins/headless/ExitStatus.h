// SPDX-License-Identifier: MIT
#pragma once

namespace osgHeadless
{

/// Keeps this library mapped to the end of the process, as windows, callbacks of other libraries
/// and exit handlers refer to its code and may outlive OSG's plugin registry.
void keepLibraryMapped();

/// Makes the process end with EXIT_FAILURE whatever its main() returns.
///
/// For programs like osgviewer, which return 0 when no window opened: a script that asked for a
/// picture must see that there is none. The program runs on; only its exit status changes. Exit
/// handlers that were registered before the first call are skipped.
void exitWithFailure();

/// Whether exitWithFailure() was called.
bool willExitWithFailure();

} // namespace osgHeadless
