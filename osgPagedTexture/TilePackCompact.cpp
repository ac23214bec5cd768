// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TilePack.h>

namespace osgPagedTexture
{

void copyTiles(const TilePackReader& from, TileWriter& to)
{
    const TileGrid& grid = from.getSettings().grid;
    for (std::int64_t step = 0; step < grid.getRows(0); ++step)
    {
        for (const TileRow& row : grid.getRowsFinishedAt(step))
        {
            from.forEachInRow(row,
                              [&](std::int64_t x, const TileData& tile) {
                                  to.put({row.level, x, row.y}, tile);
                              });
        }
    }
}

void compactTilePack(const std::string& path, const TilePackWriter::Options& options)
{
    TilePackReader reader(path);
    const TileStoreSettings before = reader.getSettings();
    TilePackWriter writer(path, before, options);
    // Now nobody else writes; another one may have committed before.
    reader.refresh();
    const TileStoreSettings& now = reader.getSettings();
    if (now.grid != before.grid || now.format != before.format)
    {
        throw TileStoreError(TileStoreError::Kind::Busy,
                             "osgPagedTexture::TilePack: '" + path +
                                 "' was built anew meanwhile; compact it again");
    }
    writer.setDescription(now.description);
    copyTiles(reader, writer);
    writer.commit();
}

} // namespace osgPagedTexture
