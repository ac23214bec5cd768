// SPDX-License-Identifier: MIT
#include <osgMultiRender/KeyCells.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace osgMultiRender
{

namespace
{

/// Cells with more candidates are divided, unless that has left as many so often in a row: what is
/// as far from all, as the axis of a circle, has many however small it is.
constexpr std::size_t Enough = 24;
constexpr int MostVain = 3;

/// Of one grid: cells, without their lists, and looks at candidates, some 30 ns each.
constexpr std::size_t MostCells = std::size_t(1) << 15;
constexpr std::size_t MostLooks = std::size_t(1) << 24;

/// How much wider than the segments' box the grids are.
constexpr double InnerWidth = 1.25, OuterWidth = 8.0;

/// How far beyond a cell places may be that are taken for its own: single precision has them off
/// by some 1e-7 of the grid's width.
constexpr double Slack = 1e-6;

constexpr std::uint32_t FoursOfList = KeyCells::MaxCandidates / 4;

constexpr int GridLevel = 4;
static_assert(1 << GridLevel == KeyCells::Grid, "grids are cells of that level");

glm::dvec3 nearestPoint(const KeySegment& segment, const glm::dvec3& place)
{
    const glm::dvec3 along = segment.second - segment.first;
    const double square = glm::dot(along, along);
    if (!(square > 0.0))
        return segment.first;
    return segment.first +
           std::clamp(glm::dot(place - segment.first, along) / square, 0.0, 1.0) * along;
}

/// A cube and the segments that may be the nearest ones in it.
struct Cell
{
    glm::dvec3 center{0.0};
    double half = 0.0;
    int level = 0;
    int vain = 0;          ///< Divisions in a row that have left as many candidates.
    glm::ivec3 place{0};   ///< In cells of its level.
    std::size_t index = 0; ///< Where it is stored, from GridLevel on.
    std::vector<std::uint32_t> candidates;

    Cell part(int octant) const
    {
        Cell part;
        part.half = 0.5 * half;
        part.level = level + 1;
        for (int axis = 0; axis < 3; ++axis)
        {
            const int bit = octant >> axis & 1;
            part.center[axis] = center[axis] + (bit ? part.half : -part.half);
            part.place[axis] = 2 * place[axis] + bit;
        }
        return part;
    }
};

/// Chooses of a larger cell's candidates.
class Choice
{
public:
    Choice(const std::vector<KeySegment>& segments, const Cell& cell, double slack)
        : _segments(segments), _center(cell.center), _reach(cell.half + slack)
    {
    }

    std::vector<std::uint32_t> from(const std::vector<std::uint32_t>& candidates)
    {
        const double across = 2.0 * std::sqrt(3.0) * _reach;
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t candidate : candidates)
        {
            const Near near = look(candidate);
            least = std::min(least, near.distance);
            if (near.distance <= least + across)
                _near.push_back(near);
        }
        const std::size_t rivals = std::min<std::size_t>(_near.size(), MostRivals);
        std::partial_sort(_near.begin(), _near.begin() + std::ptrdiff_t(rivals), _near.end(),
                          [](const Near& a, const Near& b) { return a.distance < b.distance; });
        std::vector<std::uint32_t> chosen;
        for (const Near& near : _near)
            if (near.distance <= least + across && !isBeaten(near))
            {
                chosen.push_back(near.segment);
                if (_rivals.size() < MostRivals) // the nearest ones beat most of the others
                    addRival(near);
            }
        return chosen;
    }

private:
    static constexpr std::size_t MostRivals = 4;

    /// What a segment is from the middle of the cell.
    struct Near
    {
        double distance = 0.0;
        glm::dvec3 place{0.0}; ///< The segment's.
        std::uint32_t segment = 0;
        bool isPoint = false;
    };

    struct Rival
    {
        Near near;
        std::array<double, 8> distances; ///< From the corners.
    };

    Near look(std::uint32_t index) const
    {
        const KeySegment& segment = _segments[index];
        const glm::dvec3 place = nearestPoint(segment, _center);
        return {glm::length(_center - place), place, index, segment.first == segment.second};
    }

    void addRival(const Near& near)
    {
        Rival rival{near, {}};
        for (int i = 0; i < 8; ++i)
        {
            glm::dvec3 corner = _center;
            for (int axis = 0; axis < 3; ++axis)
                corner[axis] += i >> axis & 1 ? _reach : -_reach;
            rival.distances[std::size_t(i)] =
                glm::length(corner - nearestPoint(_segments[near.segment], corner));
        }
        _rivals.push_back(rival);
    }

    bool isBeaten(const Near& near) const
    {
        return std::any_of(_rivals.begin(), _rivals.end(),
                           [&](const Rival& rival)
                           {
                               return near.isPoint && rival.near.isPoint
                                          ? isBeatenByPoint(near, rival.near)
                                          : isBeatenByLine(near, rival);
                           });
    }

    /// The difference of squared distances is linear.
    bool isBeatenByPoint(const Near& near, const Near& rival) const
    {
        const glm::dvec3 apart = glm::abs(near.place - rival.place);
        return near.distance * near.distance - rival.distance * rival.distance >=
               2.0 * _reach * (apart.x + apart.y + apart.z);
    }

    // The distance to a segment is not less than that to the plane through its point that is
    // nearest to the cell's middle, across the way there. This less the distance to the rival is
    // concave, so it has its least value at a corner.
    bool isBeatenByLine(const Near& near, const Rival& rival) const
    {
        if (!(near.distance > 0.0))
            return false;
        const glm::dvec3 step = (_center - near.place) * (_reach / near.distance);
        for (int i = 0; i < 8; ++i)
        {
            const double plane = near.distance + (i & 1 ? step.x : -step.x) +
                                 (i & 2 ? step.y : -step.y) + (i & 4 ? step.z : -step.z);
            if (plane < rival.distances[std::size_t(i)])
                return false;
        }
        return true;
    }

    const std::vector<KeySegment>& _segments;
    const glm::dvec3 _center;
    const double _reach; ///< From the middle to the sides.
    std::vector<Near> _near;
    std::vector<Rival> _rivals;
};

/// Fills the cells of one grid.
class Filler
{
public:
    Filler(const std::vector<KeySegment>& segments, KeyCells::Root& root,
           std::vector<std::int32_t>& cells)
        : _segments(segments), _root(root), _cells(cells), _most(cells.size() + MostCells)
    {
    }

    /// What lies within `inner` wholly is never asked for.
    void run(const KeyCells::Root* inner)
    {
        _root.first = static_cast<std::int32_t>(_cells.size());
        _cells.resize(_cells.size() +
                      std::size_t(KeyCells::Grid * KeyCells::Grid * KeyCells::Grid));
        Cell whole;
        whole.half = 0.5 * _root.size;
        whole.center = _root.low + whole.half;
        whole.candidates.resize(_segments.size());
        for (std::size_t i = 0; i < _segments.size(); ++i)
            whole.candidates[i] = static_cast<std::uint32_t>(i);
        _open.push_back(std::move(whole));
        while (!_open.empty())
        {
            const Cell cell = std::move(_open.front());
            _open.pop_front();
            if (!inner || !isWithin(cell, *inner))
                settle(cell);
        }
        _cells.resize((_cells.size() + 3) / 4 * 4);
        for (const auto& [index, list] : _lists)
            close(index, list);
    }

private:
    static bool isWithin(const Cell& cell, const KeyCells::Root& root)
    {
        const glm::dvec3 low = cell.center - cell.half - root.low;
        return std::min({low.x, low.y, low.z}) >= 0.0 &&
               std::max({low.x, low.y, low.z}) + 2.0 * cell.half <= root.size;
    }

    void settle(const Cell& cell)
    {
        const bool isDone = cell.candidates.size() <= Enough || cell.vain >= MostVain ||
                            cell.level == KeyCells::Levels || _cells.size() + 8 > _most ||
                            _looks > MostLooks;
        if (cell.level >= GridLevel && isDone)
        {
            if (!cell.candidates.empty() && cell.candidates.size() <= KeyCells::MaxCandidates)
                _lists.emplace_back(cell.index, cell.candidates);
            return; // else it is not told
        }
        if (cell.level >= GridLevel)
        {
            _cells[cell.index] = static_cast<std::int32_t>(_cells.size());
            _cells.resize(_cells.size() + 8);
        }
        for (int octant = 0; octant < 8; ++octant)
        {
            Cell part = cell.part(octant);
            _looks += cell.candidates.size();
            part.candidates = Choice(_segments, part, Slack * _root.size).from(cell.candidates);
            part.vain = part.candidates.size() == cell.candidates.size() ? cell.vain + 1 : 0;
            if (part.level == GridLevel)
                part.index =
                    std::size_t(_root.first) +
                    std::size_t((part.place.z * KeyCells::Grid + part.place.y) * KeyCells::Grid +
                                part.place.x);
            else if (part.level > GridLevel)
                part.index = std::size_t(_cells[cell.index]) + std::size_t(octant);
            _open.push_back(std::move(part));
        }
    }

    void close(std::size_t index, const std::vector<std::uint32_t>& list)
    {
        const std::size_t fours = (list.size() + 3) / 4;
        _cells[index] =
            -1 - static_cast<std::int32_t>(FoursOfList * (_cells.size() / 4) + fours - 1);
        _cells.insert(_cells.end(), list.begin(), list.end());
        _cells.resize(_cells.size() + 4 * fours - list.size(), _cells.back());
    }

    const std::vector<KeySegment>& _segments;
    KeyCells::Root& _root;
    std::vector<std::int32_t>& _cells;
    const std::size_t _most;
    std::size_t _looks = 0;
    std::deque<Cell> _open;
    std::vector<std::pair<std::size_t, std::vector<std::uint32_t>>> _lists;
};

} // namespace

KeyCells::KeyCells(const std::vector<KeySegment>& segments)
{
    if (segments.empty() || segments.size() > MaxSegments)
        return;
    _segments = segments;
    glm::dvec3 low = segments.front().first, high = low;
    for (const KeySegment& segment : segments)
    {
        low = glm::min(low, glm::min(segment.first, segment.second));
        high = glm::max(high, glm::max(segment.first, segment.second));
    }
    const glm::dvec3 extent = high - low;
    const double widest = std::max({extent.x, extent.y, extent.z});
    _cells.push_back(0); // index 0 says nothing
    const Root* inner = nullptr;
    for (std::size_t i = 0; i < _roots.size(); ++i)
    {
        Root& root = _roots[i];
        root.size = (widest > 0.0 ? widest : 1.0) * (i == 0 ? InnerWidth : OuterWidth);
        root.low = 0.5 * (low + high) - 0.5 * root.size;
        Filler(_segments, root, _cells).run(inner);
        inner = &root;
    }
}

std::optional<double> KeyCells::distance(const glm::dvec3& point) const
{
    for (const Root& root : _roots)
    {
        const glm::dvec3 share = (point - root.low) / root.size;
        const bool isIn = std::min({share.x, share.y, share.z}) >= 0.0 &&
                          std::max({share.x, share.y, share.z}) < 1.0;
        if (!isIn)
            continue;
        const glm::ivec3 place = glm::ivec3(share * double(1 << Levels));
        int shift = Levels - GridLevel;
        const glm::ivec3 in = place >> shift;
        std::int32_t cell = _cells[std::size_t(root.first + (in.z * Grid + in.y) * Grid + in.x)];
        while (cell > 0)
        {
            const glm::ivec3 bit = place >> --shift & 1;
            cell = _cells[std::size_t(cell + bit.x + 2 * bit.y + 4 * bit.z)];
        }
        if (cell == 0)
            return std::nullopt;
        const std::uint32_t list = static_cast<std::uint32_t>(-1 - cell);
        double nearest = std::numeric_limits<double>::infinity();
        const std::size_t first = 4 * std::size_t(list / FoursOfList);
        for (std::size_t i = first; i < first + 4 * (list % FoursOfList + 1); ++i)
            nearest = std::min(nearest, _segments[std::size_t(_cells[i])].distance(point));
        return nearest;
    }
    return std::nullopt;
}

} // namespace osgMultiRender
