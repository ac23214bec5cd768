// SPDX-License-Identifier: MIT
#include <osgPagedTexture/WalkOutputRows.h>

#include <osgPagedTexture/JpegCutter.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace osgPagedTexture
{

WalkOutputRows::WalkOutputRows(WalkOutput output, unsigned int members)
    : _output(std::move(output)), _marked(_output.wanted.size())
{
    for (const TileRange& range : _output.wanted)
    {
        _next.push_back(range.y);
    }
    for (unsigned int i = 0; i < members; ++i)
    {
        _members.push_back({makeTileEncoder(_output.format), {}, {}});
    }
}

void WalkOutputRows::markOccupied(const PixelRect& covered)
{
    // The grid counts from its own level 0, whose pixels these lie in.
    const int first = _output.firstLevel;
    const std::int64_t x = covered.x >> first, y = covered.y >> first;
    const std::int64_t right = ((covered.x + covered.width - 1) >> first) + 1;
    const std::int64_t bottom = ((covered.y + covered.height - 1) >> first) + 1;
    for (std::size_t level = 0; level < _output.wanted.size(); ++level)
    {
        const TileRange& wanted = _output.wanted[level];
        const TileRange touched =
            _output.grid.getTouched({x, y, right - x, bottom - y}, int(level));
        const std::int64_t lastX = std::min(touched.lastX, wanted.lastX);
        for (std::int64_t row = std::max(touched.y, wanted.y);
             row <= std::min(touched.lastY, wanted.lastY); ++row)
        {
            Columns& columns = _marked[level][row];
            columns.resize(std::size_t(std::max<std::int64_t>(wanted.lastX - wanted.x + 1, 0)));
            for (std::int64_t column = std::max(touched.x, wanted.x); column <= lastX; ++column)
            {
                columns[std::size_t(column - wanted.x)] = true;
            }
        }
    }
}

void WalkOutputRows::forEachFinished(const std::vector<LevelRows>& rows, const Visit& visit)
{
    const TileGrid& grid = _output.grid;
    for (std::size_t level = 0; level < _output.wanted.size(); ++level)
    {
        const TileRange& wanted = _output.wanted[level];
        const std::int64_t made = rows[_output.firstLevel + level].getEnd();
        for (std::int64_t& y = _next[level];
             y <= wanted.lastY && made >= std::min((y + 1) * grid.getPayload() + grid.getBorder(),
                                                   grid.getHeight(int(level)));
             ++y)
        {
            const Columns columns = std::move(_marked[level][y]);
            _marked[level].erase(y);
            for (std::int64_t x = wanted.x; x <= wanted.lastX; ++x)
            {
                visit({int(level), x, y}, !columns.empty() && columns[std::size_t(x - wanted.x)]);
            }
        }
    }
}

/// Copies a tile's pixels; what lies beyond the picture repeats its edge. Copied, since the rows of
/// a wide level lie pages apart: libjpeg, which goes through a few rows at a time, waited for
/// memory a third of its time where it read them in place.
void WalkOutputRows::gather(const PixelRect& area, int level, const LevelRows& rows,
                            Member& member) const
{
    const std::int64_t width = _output.grid.getWidth(level);
    const std::int64_t height = _output.grid.getHeight(level);
    const std::size_t channels = std::size_t(rows.getChannels());
    const std::size_t rowBytes = std::size_t(area.width) * channels;
    member.rows.resize(std::size_t(area.height));
    member.pixels.resize(rowBytes * std::size_t(area.height));
    for (std::int64_t y = 0; y < area.height; ++y)
    {
        const std::int64_t from = std::clamp<std::int64_t>(area.y + y, 0, height - 1);
        std::uint8_t* const row = member.pixels.data() + rowBytes * std::size_t(y);
        const std::int64_t left = std::max<std::int64_t>(area.x, 0);
        const std::int64_t right = std::min(area.x + area.width, width);
        std::uint8_t* to = row;
        for (std::int64_t x = area.x; x < left; ++x, to += channels)
        {
            std::memcpy(to, rows.at(0, from), channels);
        }
        std::memcpy(to, rows.at(left, from), std::size_t(right - left) * channels);
        to += std::size_t(right - left) * channels;
        for (std::int64_t x = right; x < area.x + area.width; ++x, to += channels)
        {
            std::memcpy(to, rows.at(width - 1, from), channels);
        }
        member.rows[std::size_t(y)] = row;
    }
}

TileData WalkOutputRows::encode(const TileKey& key, const std::vector<LevelRows>& rows,
                                unsigned int member, const JpegCutter* cutter,
                                const PixelRect& part)
{
    const LevelRows& level = rows[std::size_t(_output.firstLevel + key.level)];
    const PixelRect area = _output.grid.getPixels(key);
    Member& mine = _members[member];
    gather(area, key.level, level, mine);
    const TileRows tile{mine.rows.data(), int(area.width), int(area.height), level.getChannels()};
    if (cutter && !isUniform(tile))
    {
        return TileData::encoded(cutter->cut(part));
    }
    return makeTile(tile, *mine.encoder);
}

} // namespace osgPagedTexture
