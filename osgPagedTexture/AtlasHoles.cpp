// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasCells.h>

#include <algorithm>
#include <functional>
#include <map>

namespace osgPagedTexture
{

namespace
{

/// The free pieces of a line that moves down over the cells, each with the height since which it is
/// free. Pieces that adjoin are one stretch.
class FreeLine
{
public:
    using Visit = std::function<void(std::int64_t x, std::int64_t y, std::int64_t width)>;

    /// `visit` is called with the top left corners of free rectangles, as far as they are known
    /// when they get a left end.
    FreeLine(std::int64_t width, Visit visit) : _visit(std::move(visit))
    {
        release(0, width, 0);
        findCorners(0);
    }

    void release(std::int64_t left, std::int64_t right, std::int64_t y)
    {
        if (left < right)
        {
            _free[left] = {right, y};
        }
    }

    void take(std::int64_t left, std::int64_t right)
    {
        auto next = _free.lower_bound(left);
        if (next != _free.begin() && std::prev(next)->second.right > left)
        {
            --next;
        }
        while (next != _free.end() && next->first < right)
        {
            const std::int64_t from = next->first;
            const Piece piece = next->second;
            next = _free.erase(next);
            release(from, std::min(left, piece.right), piece.since);
            release(std::max(right, from), piece.right, piece.since);
        }
    }

    /// Of the stretch that holds x, or begins there.
    void findCorners(std::int64_t x)
    {
        auto piece = _free.upper_bound(x);
        if (piece == _free.begin() || std::prev(piece)->second.right <= x)
        {
            return;
        }
        --piece;
        for (int i = 0; i < MaxPieces && piece != _free.begin() &&
                        std::prev(piece)->second.right == piece->first;
             ++i)
        {
            --piece;
        }
        const std::int64_t left = piece->first;
        std::int64_t top = piece->second.since, right = left;
        for (int i = 0; i < MaxPieces && piece != _free.end() && piece->first == (i ? right : left);
             ++i, ++piece)
        {
            if (piece->second.since > top)
            {
                _visit(left, top, right - left);
                top = piece->second.since;
            }
            right = piece->second.right;
        }
        _visit(left, top, right - left);
    }

private:
    /// Bounds the time where very many pieces adjoin, as below the last photographs.
    static constexpr int MaxPieces = 64;

    struct Piece
    {
        std::int64_t right;
        std::int64_t since;
    };
    Visit _visit;
    std::map<std::int64_t, Piece> _free; ///< By their left ends.
};

struct Event
{
    std::int64_t y;
    bool begins; ///< Ends come first, so that what ends and begins at a height is never free.
    std::int64_t left;
    std::int64_t right;
    bool operator<(const Event& other) const
    {
        return y != other.y ? y < other.y : begins < other.begins;
    }
};

} // namespace

AtlasHoles::AtlasHoles(std::int64_t width, std::int64_t height, const std::vector<AtlasCell>& cells)
    : _width(width), _height(height), _taken(cells)
{
    for (const AtlasCell& cell : cells)
    {
        _taken.add(cell);
    }
    findCorners(cells);
}

void AtlasHoles::findCorners(const std::vector<AtlasCell>& cells)
{
    std::vector<Event> events;
    events.reserve(2 * cells.size());
    for (const AtlasCell& cell : cells)
    {
        const std::int64_t left = std::clamp<std::int64_t>(cell.x, 0, _width);
        const std::int64_t right = std::clamp<std::int64_t>(cell.right(), left, _width);
        events.push_back({std::max<std::int64_t>(cell.y, 0), true, left, right});
        events.push_back({std::max<std::int64_t>(cell.bottom(), 0), false, left, right});
    }
    std::sort(events.begin(), events.end());
    FreeLine line(_width,
                  [&](std::int64_t x, std::int64_t y, std::int64_t width) {
                      _corners.insert({width, {x, y}});
                  });
    for (auto event = events.begin(); event != events.end();)
    {
        const auto same = event;
        for (; event != events.end() && event->y == same->y; ++event)
        {
            event->begins ? line.take(event->left, event->right)
                          : line.release(event->left, event->right, event->y);
        }
        for (auto each = same; each != event; ++each)
        {
            line.findCorners(each->begins ? each->right : each->left);
        }
    }
}

bool AtlasHoles::place(AtlasCell& cell, std::size_t maxTries,
                       const std::function<bool(const AtlasCell&)>& accept)
{
    auto corner = _corners.lower_bound(cell.width);
    for (; corner != _corners.end() && maxTries > 0; ++corner, --maxTries)
    {
        cell.x = corner->second.x;
        cell.y = corner->second.y;
        if (cell.bottom() > _height || !accept(cell) || _taken.anyOver(cell))
        {
            continue;
        }
        const std::int64_t rest = corner->first - cell.width;
        _corners.erase(corner);
        if (rest > 0)
        {
            _corners.insert({rest, {cell.right(), cell.y}});
        }
        _corners.insert({cell.width, {cell.x, cell.bottom()}});
        _taken.add(cell);
        return true;
    }
    return false;
}

} // namespace osgPagedTexture
