// SPDX-License-Identifier: MIT
#pragma once

#include "BuildConfig.h"

#include <osgPagedTexture/TileUpdate.h>

namespace tilestore
{

/// Places the photographs of a build; `failures` gets a line for each that cannot be read. Throws
/// where there are none.
osgPagedTexture::AtlasLayout makeLayout(const BuildConfig& build,
                                        std::vector<std::string>& failures);

/// What the store's description says.
osgPagedTexture::TileStoreOrigin originOf(const BuildConfig& build,
                                          const osgPagedTexture::AtlasLayout& layout);

/// Gives the tiles 4 channels where nothing is asked for, and a photograph and the format have
/// alpha; with 4, the background is transparent where no other is asked for.
void chooseChannels(BuildConfig& build, const osgPagedTexture::AtlasLayout& layout);

/// `build --shard I/N`. Returns the exit status.
int runShard(BuildConfig build, const Arguments& arguments);

} // namespace tilestore
