// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileWalk.h>

#include <osgPagedTexture/HalveRow.h>
#include <osgPagedTexture/JpegCutter.h>
#include <osgPagedTexture/WalkOutputRows.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

namespace
{

std::int64_t halvedUp(std::int64_t value, int level)
{
    return (value + (std::int64_t(1) << level) - 1) >> level;
}

/// Rows of a level that are held. Those of level 0 for the next tiles are painted while those of
/// the last ones are encoded.
std::int64_t rowsHeld(const WalkSettings& settings, int level)
{
    const std::int64_t payload = settings.bandRows;
    const std::int64_t band = level == 0 ? 2 * payload : halvedUp(payload, level) + 1;
    return payload + 2 * std::int64_t(settings.border) + band;
}

} // namespace

std::vector<TileRange> WalkOutput::everything(const TileGrid& grid)
{
    std::vector<TileRange> ranges;
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        ranges.push_back({level, 0, 0, grid.getColumns(level) - 1, grid.getRows(level) - 1});
    }
    return ranges;
}

struct TileWalk::Job
{
    Output* output = nullptr;
    TileKey key;
    bool occupied = false;
    TileData tile;
    std::shared_ptr<JpegCutter> cutter; ///< Or null.
    PixelRect part{};                   ///< That it cuts.
};

class TileWalk::Output : public WalkOutputRows
{
public:
    using WalkOutputRows::WalkOutputRows;
};

std::uint64_t TileWalk::getRowBytes(const WalkSettings& settings)
{
    std::uint64_t bytes = 0;
    for (int level = 0; level < settings.levels; ++level)
    {
        bytes += std::uint64_t(halvedUp(settings.window.width, level)) *
                 std::uint64_t(rowsHeld(settings, level)) * std::uint64_t(settings.channels);
    }
    return bytes;
}

TileWalk::TileWalk(const AtlasLayout& layout, const WalkSettings& settings,
                   std::vector<WalkOutput> outputs, CoreTeam& team)
    : _layout(layout), _settings(settings), _team(team),
      _painter(layout, {settings.folder, settings.window, settings.channels, settings.background,
                        settings.cut})
{
    const PixelRect& window = settings.window;
    for (int level = 0; level < settings.levels; ++level)
    {
        const std::int64_t x = window.x >> level;
        _rows.emplace_back(x, halvedUp(window.x + window.width, level) - x, window.y >> level,
                           rowsHeld(settings, level), settings.channels);
    }
    for (WalkOutput& output : outputs)
    {
        _outputs.push_back(std::make_unique<Output>(std::move(output), team.getSize()));
    }
}

TileWalk::~TileWalk() = default;

/// Makes the rows of a level that the rows of the finer one now allow.
void TileWalk::makeCoarser(int level)
{
    constexpr std::int64_t columnsAtATime = 512;
    const LevelRows& fine = _rows[level - 1];
    LevelRows& coarse = _rows[level];
    const PixelRect& window = _settings.window;
    const std::int64_t fineEnd = halvedUp(window.y + window.height, level - 1);
    const std::int64_t begin = coarse.getEnd();
    const std::int64_t end = fine.getEnd() == fineEnd ? halvedUp(fineEnd, 1) : fine.getEnd() / 2;
    const std::int64_t parts =
        begin < end ? (coarse.getWidth() + columnsAtATime - 1) / columnsAtATime : 0;
    _team.run(std::size_t(parts),
              [&](std::size_t part, unsigned int)
              {
                  const std::int64_t first = std::int64_t(part) * columnsAtATime;
                  const std::int64_t columns =
                      std::min(2 * columnsAtATime, fine.getWidth() - 2 * first);
                  for (std::int64_t y = begin; y < end; ++y)
                  {
                      const std::int64_t x = fine.getX() + 2 * first;
                      halveRow(fine.at(x, 2 * y), fine.at(x, std::min(2 * y + 1, fineEnd - 1)),
                               std::size_t(columns), _settings.channels, _settings.linearLight,
                               coarse.at(coarse.getX() + first, y));
                  }
              });
    coarse.setEnd(std::max(begin, end));
}

void TileWalk::markBegun()
{
    for (std::size_t photo : _painter.getBegun())
    {
        for (const auto& output : _outputs)
        {
            output->markOccupied(_layout.getCovered(_layout.photos[photo]));
        }
    }
}

void TileWalk::collectJobs()
{
    for (const auto& output : _outputs)
    {
        output->forEachFinished(_rows,
                                [&](const TileKey& key, bool occupied)
                                {
                                    _jobs.push_back({output.get(), key, occupied, {}, {}, {}});
                                    findCutter(_jobs.back());
                                });
    }
}

void TileWalk::findCutter(Job& job) const
{
    if (_settings.cut && job.occupied && job.output->isCut(job.key))
    {
        job.cutter = _painter.findCutter(job.output->getPixels(job.key), job.part);
    }
}

void TileWalk::encode(Job& job, unsigned int member)
{
    if (job.occupied)
    {
        job.tile = job.output->encode(job.key, _rows, member, job.cutter.get(), job.part);
        job.cutter.reset();
    }
}

void TileWalk::putTiles(const std::vector<Job>& jobs)
{
    for (const Job& job : jobs)
    {
        job.output->put(job.key, job.tile);
    }
}

void TileWalk::run()
{
    const PixelRect& window = _settings.window;
    const std::int64_t end = window.y + window.height;
    const auto bandEnd = [&](std::int64_t y)
    { return std::min((y / _settings.bandRows + 1) * _settings.bandRows, end); };

    std::int64_t painted = window.y;
    std::vector<Job> finished; // of the band before, to be put while the next ones are encoded
    while (painted < end || !_jobs.empty())
    {
        std::size_t parts = 0;
        const std::int64_t next = painted < end ? bandEnd(painted) : painted;
        if (next > painted)
        {
            parts = _painter.begin(painted, next);
            markBegun();
        }
        _team.run(parts + _jobs.size() + 1,
                  [&](std::size_t part, unsigned int member)
                  {
                      if (part == 0)
                      {
                          putTiles(finished);
                      }
                      else if (part <= parts)
                      {
                          _painter.paint(part - 1, _rows[0]);
                      }
                      else
                      {
                          encode(_jobs[part - 1 - parts], member);
                      }
                  });
        finished = std::move(_jobs);
        _jobs.clear();
        painted = next;
        const std::int64_t before = _rows.back().getEnd();
        _rows[0].setEnd(painted);
        for (int level = 1; level < _settings.levels; ++level)
        {
            makeCoarser(level);
        }
        for (std::int64_t y = before; lastLevelRow && y < _rows.back().getEnd(); ++y)
        {
            lastLevelRow(y, _rows.back().row(y));
        }
        collectJobs();
        if (progress)
        {
            progress(painted - window.y);
        }
    }
    putTiles(finished);
}

} // namespace osgPagedTexture
