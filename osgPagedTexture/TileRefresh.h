// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/KeptLevels.h>
#include <osgPagedTexture/TileUpdate.h>

#include <set>
#include <tuple>

namespace osgPagedTexture
{

/// Makes the tiles of parts of a packed store again, and commits them.
class TileRefresh
{
public:
    /// `origin`: of the store as it will be.
    TileRefresh(const std::string& path, const AtlasLayout& layout, const TileStoreOrigin& origin,
                const TilePackWriter::Options& options);

    /// Whether the coarse pixels that this needs are there. Else one line says why not.
    std::string whyImpossible() const;
    /// The tiles of level 0 that show changed pixels, in all that there are; above 1 where parts
    /// overlap.
    double getShare() const;

    void run(TileUpdateReport& report);
    /// Photographs that run() could not read.
    const std::vector<PhotoFailure>& getUnread() const { return _unread; }

private:
    using Key = std::tuple<int, std::int64_t, std::int64_t>; ///< Level, y, x.
    void openWriter();
    void refreshFine(const PixelRect& part, TileUpdateReport& report);
    void refreshCoarse(TileUpdateReport& report);
    void refreshCoarse(const PixelRect& part, int level, TileUpdateReport& report);
    bool isNext(const TileKey& key);
    void put(const TileKey& key, const TileData& tile, TileUpdateReport& report);

    const std::string _path;
    const AtlasLayout& _layout;
    const TileStoreOrigin _origin;
    const TilePackWriter::Options _options;
    TileBuilder _builder;
    AtlasOccupancy _occupancy;
    TilePackReader _before;
    std::unique_ptr<KeptLevels> _kept;
    std::unique_ptr<TilePackWriter> _writer;
    std::set<Key> _done;
    std::vector<PhotoFailure> _unread;
};

} // namespace osgPagedTexture
