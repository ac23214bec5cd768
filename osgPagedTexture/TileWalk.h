// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasPainter.h>
#include <osgPagedTexture/CoreTeam.h>
#include <osgPagedTexture/LevelRows.h>
#include <osgPagedTexture/TileFormat.h>
#include <osgPagedTexture/TileStore.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Tiles that a walk makes.
struct WalkOutput
{
    TileGrid grid;
    int firstLevel = 0; ///< Of the walk, which is level 0 of the grid.
    /// By level of the grid. Their pixels must lie in the walk's window.
    std::vector<TileRange> wanted;
    TileFormat format;
    /// Gets each wanted tile, also those of nothing, in the order of
    /// TileGrid::getRowsFinishedAt(), x ascending; from one thread at a time.
    std::function<void(const TileKey& key, const TileData& tile)> put;

    static std::vector<TileRange> everything(const TileGrid& grid);
};

struct WalkSettings
{
    std::string folder; ///< Of the photographs.
    /// What of the atlas is walked over. Its sides are multiples of 2^(levels - 1), or the
    /// atlas's own.
    PixelRect window;
    int levels = 1;
    int bandRows = 256; ///< Of level 0, that are made at a time: the payload of a tile.
    int border = 0;     ///< The largest of the outputs.
    int channels = 3;
    bool linearLight = true;
    TileColor background{255, 255, 255, 255};
    bool cut = false; ///< JPEG tiles of level 0 without loss where a photograph allows it.
};

/// Walks down an atlas: decodes photographs, makes the coarser levels from the finer ones while
/// their rows are there, and encodes each tile as soon as its last row is. Memory: four rows of
/// tiles as wide as the window, and what the open photographs take. The result does not depend on
/// the number of threads.
class TileWalk
{
public:
    TileWalk(const AtlasLayout& layout, const WalkSettings& settings,
             std::vector<WalkOutput> outputs, CoreTeam& team);
    ~TileWalk();

    /// Gets each row of the last level, from the top; set before run().
    std::function<void(std::int64_t y, const std::uint8_t* pixels)> lastLevelRow;
    /// Told now and then how many rows of level 0 are done.
    std::function<void(std::int64_t rows)> progress;

    /// Throws TileStoreError, and what put() throws.
    void run();

    std::vector<PhotoFailure> getFailures() const { return _painter.getFailures(); }

    /// Bytes that the rows of such a walk take.
    static std::uint64_t getRowBytes(const WalkSettings& settings);

private:
    class Output;
    struct Job;

    void makeCoarser(int level);
    void markBegun();
    void collectJobs();
    void findCutter(Job& job) const;
    void encode(Job& job, unsigned int member);
    void putTiles(const std::vector<Job>& jobs);

    const AtlasLayout& _layout;
    const WalkSettings _settings;
    CoreTeam& _team;
    AtlasPainter _painter;
    std::vector<LevelRows> _rows; ///< By level of the walk.
    std::vector<std::unique_ptr<Output>> _outputs;
    std::vector<Job> _jobs;
};

} // namespace osgPagedTexture
