// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasCells.h>

#include <osgPagedTexture/TileStore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace osgPagedTexture
{

namespace
{

std::int64_t divideDown(std::int64_t value, std::int64_t divisor)
{
    return value >= 0 ? value / divisor : -((divisor - 1 - value) / divisor);
}

std::int64_t divideUp(std::int64_t value, std::int64_t divisor)
{
    return -divideDown(-value, divisor);
}

/// Where the block of pixels begins that the first placed one lies in.
std::int64_t blockStart(const AtlasLayout& layout, std::int64_t boxStart)
{
    return boxStart - boxStart % layout.alignment;
}

} // namespace

AtlasCell cellOf(const AtlasLayout& layout, const AtlasPhoto& photo)
{
    const PixelRect box = photo.getBox();
    const std::int64_t unit = layout.alignment;
    const std::int64_t left = photo.x + blockStart(layout, box.x) - layout.alignmentOffset;
    const std::int64_t top = photo.y + blockStart(layout, box.y) - layout.alignmentOffset;
    const std::int64_t right =
        photo.x + box.x + box.width + 2 * std::int64_t(layout.padding) - layout.alignmentOffset;
    const std::int64_t bottom =
        photo.y + box.y + box.height + 2 * std::int64_t(layout.padding) - layout.alignmentOffset;
    AtlasCell cell{divideDown(left, unit), divideDown(top, unit)};
    cell.width = divideUp(right, unit) - cell.x;
    cell.height = divideUp(bottom, unit) - cell.y;
    return cell;
}

void moveToCell(const AtlasLayout& layout, AtlasPhoto& photo, std::int64_t x, std::int64_t y)
{
    const PixelRect box = photo.getBox();
    photo.x = layout.alignmentOffset + x * layout.alignment - blockStart(layout, box.x);
    photo.y = layout.alignmentOffset + y * layout.alignment - blockStart(layout, box.y);
}

void growAroundPhotos(AtlasLayout& layout)
{
    for (const AtlasPhoto& photo : layout.photos)
    {
        const PixelRect place = photo.getPlace();
        layout.width = std::max(layout.width, place.x + place.width);
        layout.height = std::max(layout.height, place.y + place.height);
    }
    if (layout.width > TileGrid::MaxSide || layout.height > TileGrid::MaxSide)
    {
        throw TileStoreError(TileStoreError::Kind::Refused,
                             "osgPagedTexture::AtlasLayout: the photographs need an atlas with "
                             "sides over 2^40 pixels; make several atlases");
    }
}

std::int64_t unitsIn(const AtlasLayout& layout, std::int64_t pixels)
{
    // The last padding may hang over the edge, where nothing follows.
    const std::int64_t room = pixels - layout.alignmentOffset + 2 * std::int64_t(layout.padding);
    return std::max<std::int64_t>(divideDown(room, layout.alignment), 0);
}

AtlasSkyline::AtlasSkyline(std::int64_t width, const std::vector<AtlasCell>& cells)
    : AtlasSkyline(width)
{
    std::vector<AtlasCell> sorted = cells;
    std::sort(sorted.begin(), sorted.end(),
              [](const AtlasCell& a, const AtlasCell& b) { return a.bottom() < b.bottom(); });
    std::map<std::int64_t, std::int64_t> heights{{0, 0}, {width, 0}}; // from this x on
    for (const AtlasCell& cell : sorted)
    {
        const std::int64_t left = std::clamp<std::int64_t>(cell.x, 0, width);
        const std::int64_t right = std::clamp<std::int64_t>(cell.right(), left, width);
        const std::int64_t behind = std::prev(heights.upper_bound(right))->second;
        heights.erase(heights.lower_bound(left), heights.upper_bound(right));
        heights[left] = cell.bottom();
        heights[right] = behind;
    }
    _steps.clear();
    for (auto step = heights.begin(); step->first < width; ++step)
    {
        _steps.push_back({step->first, std::next(step)->first - step->first, step->second});
        _bottom = std::max(_bottom, step->second);
    }
}

void AtlasSkyline::placeAll(const std::vector<AtlasCell*>& cells)
{
    std::set<std::tuple<std::int64_t, std::int64_t, std::size_t>> left; // the last is taken first
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        left.insert({cells[i]->width, cells[i]->height, cells.size() - 1 - i});
    }
    while (!left.empty())
    {
        const AtlasCell room = getHighestRoom();
        const auto wider = left.lower_bound({room.width + 1, 0, 0});
        if (wider == left.begin())
        {
            closeRoom(room);
            continue;
        }
        AtlasCell& cell = *cells[cells.size() - 1 - std::get<2>(*std::prev(wider))];
        cell.x = room.x;
        cell.y = room.y;
        raise(cell);
        left.erase(std::prev(wider));
    }
}

AtlasCell AtlasSkyline::getHighestRoom() const
{
    const auto step = std::min_element(_steps.begin(), _steps.end(),
                                       [](const Step& a, const Step& b) { return a.y < b.y; });
    return {step->x, step->y, step->width, 0};
}

void AtlasSkyline::closeRoom(const AtlasCell& room)
{
    std::int64_t next = std::numeric_limits<std::int64_t>::max();
    for (const Step& step : _steps)
    {
        if (step.x + step.width == room.x || step.x == room.right())
        {
            next = std::min(next, step.y);
        }
    }
    raise({room.x, room.y, room.width, next - room.y});
}

void AtlasSkyline::raise(const AtlasCell& cell)
{
    _bottom = std::max(_bottom, cell.bottom());
    std::size_t first = 0;
    while (_steps[first].x < cell.x)
    {
        ++first;
    }
    std::size_t end = first;
    while (end < _steps.size() && _steps[end].x + _steps[end].width <= cell.right())
    {
        ++end;
    }
    if (end < _steps.size() && _steps[end].x < cell.right())
    {
        _steps[end].width -= cell.right() - _steps[end].x;
        _steps[end].x = cell.right();
    }
    const auto at = [&](std::size_t i) { return _steps.begin() + static_cast<std::ptrdiff_t>(i); };
    Step step{cell.x, cell.width, cell.bottom()};
    if (first > 0 && _steps[first - 1].y == step.y)
    {
        --first;
        step.x = _steps[first].x;
        step.width += _steps[first].width;
    }
    if (end < _steps.size() && _steps[end].y == step.y)
    {
        step.width += _steps[end].width;
        ++end;
    }
    _steps.insert(_steps.erase(at(first), at(end)), step);
    // Photographs of wild sizes would make the search long: then what is above is done with.
    constexpr std::size_t maxSteps = 4096;
    if (_steps.size() > maxSteps)
    {
        _steps.assign(1, {0, _width, _bottom});
    }
}

AtlasCellIndex::AtlasCellIndex(const std::vector<AtlasCell>& cells)
{
    double width = 1.0, height = 1.0;
    std::int64_t right = 1, bottom = 1;
    for (const AtlasCell& cell : cells)
    {
        width += double(cell.width) / double(cells.size());
        height += double(cell.height) / double(cells.size());
        right = std::max(right, cell.right());
        bottom = std::max(bottom, cell.bottom());
    }
    // Few photographs in a huge atlas need no more buckets than there are photographs.
    const double most = 4.0 * double(cells.size()) + 16.0;
    const double buckets = double(right) / width * (double(bottom) / height);
    const double coarser = std::sqrt(std::max(buckets / most, 1.0));
    _bucketWidth = std::llround(width * coarser);
    _bucketHeight = std::llround(height * coarser);
    _columns = right / _bucketWidth + 1;
    _rows = bottom / _bucketHeight + 1;
    _first.assign(std::size_t(_columns * _rows), ~std::uint32_t(0));
    _cells.reserve(cells.size());
}

template <typename Visit>
bool AtlasCellIndex::forEachBucket(const AtlasCell& cell, const Visit& visit) const
{
    const auto column = [&](std::int64_t x)
    { return std::clamp<std::int64_t>(x / _bucketWidth, 0, _columns - 1); };
    const auto row = [&](std::int64_t y)
    { return std::clamp<std::int64_t>(y / _bucketHeight, 0, _rows - 1); };
    for (std::int64_t y = row(cell.y); y <= row(cell.bottom() - 1); ++y)
    {
        for (std::int64_t x = column(cell.x); x <= column(cell.right() - 1); ++x)
        {
            if (visit(std::size_t(y * _columns + x)))
            {
                return true;
            }
        }
    }
    return false;
}

void AtlasCellIndex::add(const AtlasCell& cell)
{
    const auto number = static_cast<std::uint32_t>(_cells.size());
    _cells.push_back(cell);
    forEachBucket(cell,
                  [&](std::size_t bucket)
                  {
                      _links.push_back({number, _first[bucket]});
                      _first[bucket] = static_cast<std::uint32_t>(_links.size() - 1);
                      return false;
                  });
}

bool AtlasCellIndex::anyOverIn(std::size_t bucket, const AtlasCell& cell,
                               const std::function<bool(std::size_t)>& visit) const
{
    for (std::uint32_t link = _first[bucket]; link != ~std::uint32_t(0); link = _links[link].next)
    {
        if (_cells[_links[link].cell].overlaps(cell) && visit(_links[link].cell))
        {
            return true;
        }
    }
    return false;
}

bool AtlasCellIndex::anyOver(const AtlasCell& cell,
                             const std::function<bool(std::size_t)>& visit) const
{
    return forEachBucket(cell, [&](std::size_t bucket) { return anyOverIn(bucket, cell, visit); });
}

} // namespace osgPagedTexture
