// SPDX-License-Identifier: MIT
#include <osgMultiRender/MergeProgram.h>

namespace osgMultiRender
{

void shareEntities(const std::vector<MergeProgram*>&, MergeStatistics&) {}

} // namespace osgMultiRender
