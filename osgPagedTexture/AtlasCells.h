// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace osgPagedTexture
{

/// The room of a photograph: a rectangle in units of the layout's alignment. It begins at the
/// photograph's block of pixels and ends with twice the padding, so that neighbours in all
/// directions have their padding between them.
struct AtlasCell
{
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t width = 0;
    std::int64_t height = 0;

    std::int64_t right() const { return x + width; }
    std::int64_t bottom() const { return y + height; }
    bool overlaps(const AtlasCell& other) const
    {
        return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
    }
};

/// The cell of a photograph at its place; of a place that is not aligned, what encloses it.
AtlasCell cellOf(const AtlasLayout& layout, const AtlasPhoto& photo);

/// Moves the photograph to where its cell is at x, y.
void moveToCell(const AtlasLayout& layout, AtlasPhoto& photo, std::int64_t x, std::int64_t y);

/// Makes the atlas large enough for all its photographs.
void growAroundPhotos(AtlasLayout& layout);

/// How many units of cells lie side by side in an atlas of so many pixels.
std::int64_t unitsIn(const AtlasLayout& layout, std::int64_t pixels);

/// The lower contour of what has been placed, as steps from left to right.
class AtlasSkyline
{
public:
    explicit AtlasSkyline(std::int64_t width) : _steps{{0, width, 0}}, _width(width) {}
    /// That of cells which have places.
    AtlasSkyline(std::int64_t width, const std::vector<AtlasCell>& cells);

    /// Gives all cells places below the contour: each room takes the widest that fits, of those the
    /// tallest (Burke, Kendall and Whitwell, A New Placement Heuristic for the Orthogonal
    /// Stock-Cutting Problem, 2004). None may be wider than the skyline.
    void placeAll(const std::vector<AtlasCell*>& cells);
    std::int64_t getBottom() const { return _bottom; }

private:
    struct Step
    {
        std::int64_t x;
        std::int64_t width;
        std::int64_t y;
    };
    /// The highest room between two higher steps, as a cell without height. The leftmost of equals.
    AtlasCell getHighestRoom() const;
    /// Closes that room where nothing fits.
    void closeRoom(const AtlasCell& room);
    /// Places the cell at its x and y.
    void raise(const AtlasCell& cell);

    std::vector<Step> _steps;
    std::int64_t _width;
    std::int64_t _bottom = 0;
};

/// Finds cells that lie over each other, in a time that does not grow with their number.
class AtlasCellIndex
{
public:
    /// Good for cells about as large and many as these, which are not added.
    AtlasCellIndex(const std::vector<AtlasCell>& cells);

    void add(const AtlasCell& cell);
    /// Calls until it returns true, which is then the result, with the numbers of cells that lie
    /// over this one, in the order they were added.
    bool anyOver(
        const AtlasCell& cell,
        const std::function<bool(std::size_t)>& visit = [](std::size_t) { return true; }) const;

private:
    struct Link
    {
        std::uint32_t cell;
        std::uint32_t next;
    };
    bool anyOverIn(std::size_t bucket, const AtlasCell& cell,
                   const std::function<bool(std::size_t)>& visit) const;
    template <typename Visit> bool forEachBucket(const AtlasCell& cell, const Visit& visit) const;

    std::int64_t _bucketWidth;
    std::int64_t _bucketHeight;
    std::int64_t _columns;
    std::int64_t _rows;
    std::vector<AtlasCell> _cells;
    std::vector<std::uint32_t> _first; ///< Of each bucket, a link.
    std::vector<Link> _links;
};

/// The free places between cells, for more of them.
class AtlasHoles
{
public:
    /// `width` and `height` of the room that the cells are in.
    AtlasHoles(std::int64_t width, std::int64_t height, const std::vector<AtlasCell>& cells);

    /// Gives the cell a place in a hole that `accept` agrees to; false where none is found in
    /// `maxTries` looks.
    bool place(AtlasCell& cell, std::size_t maxTries,
               const std::function<bool(const AtlasCell&)>& accept);

private:
    void findCorners(const std::vector<AtlasCell>& cells);

    struct Corner ///< The top left corner of a free strip.
    {
        std::int64_t x;
        std::int64_t y;
    };
    std::int64_t _width;
    std::int64_t _height;
    AtlasCellIndex _taken;
    std::multimap<std::int64_t, Corner> _corners; ///< By the strip's width.
};

} // namespace osgPagedTexture
