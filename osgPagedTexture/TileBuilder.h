// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/TileFormat.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// A photograph that is wrong in part or as a whole.
struct PhotoFailure
{
    std::size_t photo = 0; ///< Its place in the layout's list.
    std::string cause;     ///< One line that names the file and a remedy.
};

struct TileBuildSettings
{
    int tileSide = 256; ///< Payload and both borders, in pixels.
    int border = 1;     ///< Pixels of the neighbours that a tile has on each side.
    TileGrid::Edge edge = TileGrid::Edge::Padded;
    TileFormat format;
    int channels = 3;        ///< Of the tiles: 1 grey, 3 RGB, 4 RGBA.
    bool linearLight = true; ///< Coarser levels average light, not sRGB code values.
    TileColor background{255, 255, 255, 255}; ///< Where there is no photograph.
    /// JPEG tiles of level 0 that lie in one JPEG are cut out of it without loss where its blocks
    /// allow it. Needs three bytes for each pixel of the photographs that cross a row of tiles.
    bool lossless = false;
    /// Tiles of nothing are uniform ones of the background, for programs that ask for every tile.
    bool everyTile = false;
    unsigned int threads = 0; ///< 0: as many as the machine has cores.
    /// For the rows that are in the making; building throws where the atlas is too wide for it.
    std::uint64_t maxBytes = std::uint64_t(1) << 30;
};

struct TileBuildReport
{
    std::uint64_t encodedTiles = 0;
    std::uint64_t uniformTiles = 0;
    std::uint64_t absentTiles = 0; ///< That hold nothing of any photograph.
    std::uint64_t tileBytes = 0;
    std::vector<PhotoFailure> failures; ///< Their pixels are the background from there on.
};

/// Photographs that could not be read are left to the next update, which tries them again: what
/// they cover becomes pending beside what is. `failures`: of a build from this layout.
OSGPAGEDTEXTURE_EXPORT void addPending(AtlasLayout& layout,
                                       const std::vector<PhotoFailure>& failures);

/// Unencoded pixels of a part of a level, the top row first.
struct LevelPixels
{
    int level = 0;
    PixelRect area;
    std::vector<std::uint8_t> bytes; ///< Rows of area.width * channels.
};

/// Makes the tiles of an atlas from its photographs, without ever having the atlas: it is walked
/// down once, each photograph is decoded once, rows of the coarser levels are averaged from those
/// of the finer ones before they are encoded. Memory is some rows of tiles as wide as the atlas.
/// The tiles are the same for any number of threads. One thread uses it at a time.
class OSGPAGEDTEXTURE_EXPORT TileBuilder
{
public:
    /// The finest level whose unencoded pixels are worth keeping for updates: all that are coarser
    /// together take 1/48 of the atlas before they are compressed.
    static constexpr int KeptLevel = 3;

    /// `folder`: that the photographs' paths are relative to. Throws TileStoreError::Kind::Refused.
    TileBuilder(const AtlasLayout& layout, const std::string& folder,
                const TileBuildSettings& settings);
    ~TileBuilder();
    TileBuilder(const TileBuilder&) = delete;
    TileBuilder& operator=(const TileBuilder&) = delete;

    const TileGrid& getGrid() const;
    /// Of the store with the unencoded pixels, whose level 0 is KeptLevel: PNG without a border.
    /// False where the atlas has no such level.
    bool getKeptSettings(TileStoreSettings& settings) const;

    /// Told the rows of level 0 that are done and that there are.
    using Progress = std::function<void(std::uint64_t done, std::uint64_t total)>;

    /// Puts all tiles that are not nothing, and into `kept`, which may be null, the unencoded
    /// pixels. Commits nothing. Throws TileStoreError.
    TileBuildReport build(TileWriter& store, TileWriter* kept, const Progress& progress = {});

    /// Makes the tiles of the levels below KeptLevel that hold any pixel of `changed`, in pixels of
    /// level 0, and puts them, also those of nothing. `coarse` gets the changed pixels of KeptLevel
    /// or, where the atlas has less levels, none. Decodes the photographs around, as far as the
    /// tiles reach. Throws TileStoreError.
    using Put = std::function<void(const TileKey& key, const TileData& tile)>;
    TileBuildReport rebuild(const PixelRect& changed, const Put& put, LevelPixels& coarse);

    /// A tile of these pixels, the top row first, as build() makes it; a kept one is not for the
    /// store itself.
    TileData encode(const std::uint8_t* const* rows, int width, int height, bool kept = false);

private:
    struct Content;
    std::unique_ptr<Content> _content;
};

} // namespace osgPagedTexture
