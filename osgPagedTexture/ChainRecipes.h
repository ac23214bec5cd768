// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ChainLoader.h>
#include <osgPagedTexture/PagedSettings.h>
#include <osgPagedTexture/TextureUse.h>

#include <memory>
#include <string>

namespace osgPagedTexture
{

struct ContextAbilities;

/// The format for a picture of so many channels, of what GL has.
BlockFormat formatFor(int channels, bool translucent, TextureUse use, Compression compression,
                      const ContextAbilities& abilities);

/// How pictures become chains of a format. Equal arguments give equal chains.
std::shared_ptr<const ChainRecipe> recipeFor(BlockFormat format, TextureUse use,
                                             EncodeQuality quality);

/// "~/.cache/osgPagedTexture" as the system has it, for "default"; empty for "off".
std::string cacheFolder(const std::string& setting);

} // namespace osgPagedTexture
