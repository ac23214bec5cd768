// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

namespace osgMultiRender
{

/// Lets the calling thread run on all the cores that the program had when this library was loaded
/// (those of `taskset`, where it was used). Threads begin on the cores of the thread that starts
/// them, and osgViewer binds the thread that draws to one: without this all helpers of a viewer
/// share that core with it while others rest. Called at the start of each helper's work; costs a
/// microsecond, and does nothing where threads are not bound in this way (all but Linux).
OSGMULTIRENDER_EXPORT void useAllCores();

} // namespace osgMultiRender
