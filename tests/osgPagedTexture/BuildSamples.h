// SPDX-License-Identifier: MIT
// Folders of photographs and the stores that are built of them.
#pragma once

#include "PictureFiles.h"

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/Pixels.h>
#include <osgPagedTexture/TileBuilder.h>
#include <osgPagedTexture/TilePack.h>

#include <support/TemporaryFolder.h>

#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Photographs on the disk and in memory, and their layout.
class PhotoWall
{
public:
    /// A PNG of random content, or another lossless format by the name's ending.
    void add(const std::string& name, int width, int height, int channels = 3);
    /// Any file; `pixels` is what it shows.
    void addFile(const std::string& name, const std::string& bytes, Pixels pixels);

    /// Lays out what was added.
    void place(const AtlasSettings& settings = {});

    std::string folder() const { return _folder.getPath().string(); }
    std::string file(const std::string& name) const { return _folder.file(name); }

    AtlasLayout layout;
    std::vector<Pixels> photos;

private:
    support::TemporaryFolder _folder;
    std::vector<AtlasPhoto> _placed;
};

/// PNG tiles of 32 pixels with a border of 3.
TileBuildSettings smallTiles();

/// Builds into `<folder>/<name>` and, unless `kept` is empty, `<folder>/<kept>`.
TileBuildReport buildInto(const PhotoWall& wall, const TileBuildSettings& settings,
                          const std::string& name, const std::string& kept = {});

} // namespace osgPagedTexture
