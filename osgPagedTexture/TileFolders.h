// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileStore.h>

#include <map>
#include <string>

namespace osgPagedTexture
{

/// How tiles that are files of their own are named.
enum class FolderLayout
{
    /// `<path>/tiles_b<border>_level<L>/tile_<L>_<x>_<y>.<ext>` with `<path>/tiles.json`, which
    /// says what LibVT is told otherwise. Padded grids only. LibVT asks for every tile: put a
    /// uniform one where there is nothing.
    LibVT,
    /// `<path>`, which ends in `.dzi`, and `<path without it>_files/<level>/<x>_<y>.<ext>`, where
    /// level 0 is one pixel. Clipped grids only.
    DeepZoom
};

/// Writes each tile as a file of its own, for programs that want that: slower than a packed store
/// by far. A tile's file is replaced as a whole; what describes the store is written by commit().
class OSGPAGEDTEXTURE_EXPORT TileFolderWriter : public TileWriter
{
public:
    /// Makes the folders. `encode` is asked for the files of uniform tiles. Throws TileStoreError.
    TileFolderWriter(const std::string& path, FolderLayout layout,
                     const TileStoreSettings& settings, UniformEncoder encode);

    void put(const TileKey& key, const TileData& tile) override;
    void commit() override;

private:
    const std::string& uniformFile(const TileColor& color, const PixelRect& pixels);

    const std::string _path;
    const FolderLayout _layout;
    const TileStoreSettings _settings;
    const UniformEncoder _encode;
    std::map<std::array<std::int64_t, 6>, std::string> _uniformFiles; ///< By colour and size.
};

/// Reads such a store, also one that another program wrote where it has a `.dzi`. A tile without a
/// file is None.
class OSGPAGEDTEXTURE_EXPORT TileFolderReader : public TileReader
{
public:
    TileFolderReader(const std::string& path, FolderLayout layout);
    const TileStoreSettings& getSettings() const override { return _settings; }
    TileData read(const TileKey& key) const override;

private:
    const std::string _path;
    const FolderLayout _layout;
    TileStoreSettings _settings;
};

/// The file of a tile.
OSGPAGEDTEXTURE_EXPORT std::string tileFileName(const std::string& path, FolderLayout layout,
                                                const TileStoreSettings& settings,
                                                const TileKey& key);

} // namespace osgPagedTexture
