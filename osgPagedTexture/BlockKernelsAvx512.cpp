// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockKernels.h>

#define OSGPAGEDTEXTURE_LANES 16
#include "BlockLanes.inl"
#include "ChannelKernel.inl"
#include "ColorKernel.inl"
#include "Mode6Kernel.inl"

namespace osgPagedTexture
{

const BlockKernels avx512Kernels = {encodeColor, encodeChannel, encodeMode6};

} // namespace osgPagedTexture
