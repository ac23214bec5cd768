// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasChanges.h>
#include <osgPagedTexture/TileBuilder.h>
#include <osgPagedTexture/TilePack.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace osgPagedTexture
{

struct TileUpdateSettings
{
    bool lookInside = false;  ///< Compares the content of all photographs, whatever their time.
    bool keepMissing = false; ///< Photographs that are not there are named and keep their tiles.
    unsigned int threads = 0; ///< 0: as many as the machine has cores.
    std::uint64_t maxBytes = std::uint64_t(1) << 30; ///< See TileBuildSettings.
    /// Where more of the atlas than this share has changed, the whole store is built anew.
    double rebuildShare = 0.6;
    TilePackWriter::Options pack; ///< Also how long another update is waited for.

    /// Called when tiles were changed, with the layout and the folder of its file;
    /// AtlasLayout::pending says where. Killed meanwhile, it is called again by the next update.
    std::function<void(const AtlasLayout& layout, const std::string& folder)> afterwards;
};

struct TileUpdateReport
{
    std::size_t changed = 0, added = 0, removed = 0, moved = 0; ///< Photographs.
    std::uint64_t touchedTiles = 0;                             ///< Made again.
    std::uint64_t changedTiles = 0;                             ///< Whose bytes are others.
    std::string rebuilt; ///< Why the whole store was built anew, one line; empty where it was not.
    /// One line for each photograph that lies elsewhere now, or is kept though it is missing.
    std::vector<std::string> notes;
    std::vector<std::string> failures; ///< One line for each photograph that cannot be read.

    bool isNothing() const { return changed + added + removed + moved + touchedTiles == 0; }
};

/// What a store's description says of how it was built.
struct TileStoreOrigin
{
    TileBuildSettings settings;
    std::string layout;     ///< The file of the layout, relative to the store's folder.
    std::string layoutHash; ///< AtlasLayout::getContentHash().

    OSGPAGEDTEXTURE_EXPORT std::string text() const;
    /// Throws TileStoreError::Kind::Refused where it says nothing of a layout.
    OSGPAGEDTEXTURE_EXPORT static TileStoreOrigin parse(const std::string& description);
};

/// The packed store of coarse pixels that belongs to a packed store.
inline std::string keptPathOf(const std::string& storePath)
{
    return storePath + ".mips";
}

/// Builds a packed store from a layout's file as a whole, and the coarse pixels for its updates.
/// The former one is replaced at the end. Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT TileBuildReport buildTileStore(const std::string& path,
                                                      const AtlasLayout& layout,
                                                      const TileStoreOrigin& origin,
                                                      const TilePackWriter::Options& options,
                                                      const TileBuilder::Progress& progress = {});

/// Brings a packed store up to date with the photographs it was built from: those that have
/// changed, moved, come or gone since. Only the tiles that show a changed pixel are made again, and
/// each is byte for byte what a full build from the updated layout would make; the file is, too,
/// after compactTilePack(). Killed at any moment it leaves the old or the new store, and the next
/// update does the rest. Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT TileUpdateReport updateTileStore(const std::string& path,
                                                        const TileUpdateSettings& settings = {});

} // namespace osgPagedTexture
