// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileFolders.h>

#include <string>

namespace osgPagedTexture
{

/// The file that describes a store of folders: `tiles.json` of LibVT's layout, the `.dzi` itself.
std::string descriptionFile(const std::string& path, FolderLayout layout);
std::string writeDescription(FolderLayout layout, const TileStoreSettings& settings);
/// Throws TileStoreError.
TileStoreSettings readDescription(const std::string& path, FolderLayout layout);

} // namespace osgPagedTexture
