// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/MipChain.h>
#include <osgPagedTexture/Pixels.h>

#include <memory>

namespace osgPagedTexture
{
struct ChainRecipe;
}

/// A chain of arbitrary bytes, the same for the same seed.
osgPagedTexture::MipChain sampleChain(osgPagedTexture::BlockFormat format, int width, int height,
                                      int firstLevel = 0, unsigned int seed = 1);

/// Levels by plain halving, not encoded.
osgPagedTexture::MipChain plainChain(osgPagedTexture::Pixels pixels, int firstLevel, int fullWidth,
                                     int fullHeight);

/// Makes plain chains.
std::shared_ptr<osgPagedTexture::ChainRecipe> plainRecipe();

namespace osgPagedTexture
{
bool operator==(const MipChain& a, const MipChain& b);
}
