// SPDX-License-Identifier: MIT
#include <osgLabels/MapCoverage.h>

#include <algorithm>

namespace osgLabels
{

namespace
{

bool isSame(const FeatureTree::Range& a, const FeatureTree::Range& b)
{
    return a.first == b.first && a.last == b.last;
}

bool isIn(std::uint32_t number, const FeatureTree::Range& range)
{
    return number >= range.first && number <= range.last;
}

} // namespace

MapCoverage::MapCoverage(const PixelBox& viewport)
    : _viewport(viewport), _width((viewport.right - viewport.left) / Tiles),
      _height((viewport.top - viewport.bottom) / Tiles), _tiles(Tiles * Tiles)
{
}

bool MapCoverage::spanOf(const PixelBox& box, Span& span) const
{
    const auto tileOf = [](double at, double first, double size)
    { return int(std::clamp((at - first) / size, -1.0, double(Tiles))); };
    if (!(box.left < _viewport.right && box.right > _viewport.left && box.bottom < _viewport.top &&
          box.top > _viewport.bottom))
        return false;
    span.left = std::max(0, tileOf(box.left, _viewport.left, _width));
    span.right = std::min(Tiles - 1, tileOf(box.right, _viewport.left, _width));
    span.bottom = std::max(0, tileOf(box.bottom, _viewport.bottom, _height));
    span.top = std::min(Tiles - 1, tileOf(box.top, _viewport.bottom, _height));
    return true;
}

void MapCoverage::add(const PixelBox& box, double distance, const FeatureTree::Range& own)
{
    Span span;
    if (!spanOf(box, span))
        return;
    _box = _box.isEmpty()
               ? box
               : PixelBox{std::min(_box.left, box.left), std::min(_box.bottom, box.bottom),
                          std::max(_box.right, box.right), std::max(_box.top, box.top)};
    for (int y = span.bottom; y <= span.top; ++y)
        for (int x = span.left; x <= span.right; ++x)
        {
            Tile& tile = _tiles[std::size_t(y) * Tiles + std::size_t(x)];
            int slot = 0;
            while (slot < 2 && tile.farthest[slot] > -1e300 && !isSame(tile.own[slot], own))
                ++slot;
            tile.several = tile.several || slot == 2;
            slot = std::min(slot, 1);
            tile.own[slot] = own;
            tile.farthest[slot] = std::max(tile.farthest[slot], distance);
        }
}

bool MapCoverage::mayHide(const PixelBox& box, double distance, std::uint32_t number) const
{
    Span span;
    if (!spanOf(box, span))
        return false;
    for (int y = span.bottom; y <= span.top; ++y)
        for (int x = span.left; x <= span.right; ++x)
        {
            const Tile& tile = _tiles[std::size_t(y) * Tiles + std::size_t(x)];
            for (int slot = 0; slot < 2; ++slot)
                if (tile.farthest[slot] > distance &&
                    (tile.several || number == 0 || !isIn(number, tile.own[slot])))
                    return true;
        }
    return false;
}

bool MapCoverage::mayOwn(const PixelBox& box, std::uint32_t number) const
{
    Span span;
    if (number == FeatureTree::Foreign || !spanOf(box, span))
        return false;
    for (int y = span.bottom; y <= span.top; ++y)
        for (int x = span.left; x <= span.right; ++x)
        {
            const Tile& tile = _tiles[std::size_t(y) * Tiles + std::size_t(x)];
            const bool isAny = number == 0 && (tile.own[0].first <= tile.own[0].last ||
                                               tile.own[1].first <= tile.own[1].last);
            if (tile.several || isAny || isIn(number, tile.own[0]) || isIn(number, tile.own[1]))
                return true;
        }
    return false;
}

} // namespace osgLabels
