// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockKernels.h>

#define OSGPAGEDTEXTURE_LANES 8
#include "BlockLanes.inl"
#include "ChannelKernel.inl"
#include "ColorKernel.inl"
#include "Mode6Kernel.inl"

namespace osgPagedTexture
{

const BlockKernels avx2Kernels = {encodeColor, encodeChannel, encodeMode6};

} // namespace osgPagedTexture
