// SPDX-License-Identifier: MIT
#include <osgMultiRender/MergeProgram.h>

namespace osgMultiRender
{

void valueVaryings(MergeProgram&) {}

} // namespace osgMultiRender
