// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileBuilder.h>

#include <string>

namespace osgPagedTexture
{

/// All settings that decide a store's bytes, as JSON for TileStoreSettings::description: an update
/// makes its tiles with the same ones. Threads and memory are not among them.
OSGPAGEDTEXTURE_EXPORT std::string describeBuild(const TileBuildSettings& settings);

/// Reads them back; what is not named keeps its default. Throws TileStoreError::Kind::Refused,
/// which names the member that makes no sense; other members are passed over.
OSGPAGEDTEXTURE_EXPORT TileBuildSettings parseBuild(const std::string& json);

} // namespace osgPagedTexture
