// SPDX-License-Identifier: MIT
#include <osgMultiRender/KeyCells.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace osgMultiRender
{

namespace
{

/// Cells with more candidates are divided, unless that has left as many so often in a row: what is
/// as far from all, as the axis of a circle, has many however small it is.
constexpr std::size_t Enough = 24;
constexpr int MostVain = 3;

/// Of one grid: cells, without their lists, and looks at candidates, some 10 to 30 ns each.
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

constexpr std::size_t MostRivals = 4;

/// Segments as the search of candidates reads them.
class Candidates
{
public:
    std::size_t size() const { return _lines.size(); }

    explicit Candidates(const std::vector<KeySegment>& segments)
    {
        _lines.reserve(segments.size());
        for (const KeySegment& segment : segments)
        {
            const glm::dvec3 along = segment.second - segment.first;
            const double square = glm::dot(along, along);
            _lines.push_back({segment.first, along, square > 0.0 ? 1.0 / square : 0.0});
            _arePoints = _arePoints && !(square > 0.0);
        }
    }

    /// Of `from`, appends to `chosen` those that may be the nearest one within `reach` of the
    /// middle along each axis.
    void choose(const std::uint32_t* from, std::size_t count, const glm::dvec3& middle,
                double reach, std::vector<std::uint32_t>& chosen)
    {
        findNear(from, count, middle, 2.0 * std::sqrt(3.0) * reach);
        const std::size_t rivals = std::min<std::size_t>(_near.size(), MostRivals);
        std::partial_sort(_near.begin(), _near.begin() + std::ptrdiff_t(rivals), _near.end(),
                          [](const Near& a, const Near& b) { return a.square < b.square; });
        _numRivals = 0;
        for (const Near& near : _near)
        {
            const bool isBeaten =
                _arePoints ? isBeatenByPoint(near, reach) : isBeatenByLine(near, middle, reach);
            if (isBeaten)
                continue;
            chosen.push_back(near.segment);
            if (_numRivals < MostRivals) // the nearest ones beat most of the others
                addRival(near, middle, reach);
        }
    }

private:
    struct Line
    {
        glm::dvec3 first, along;
        double inverse; ///< 1 / the square of the length; 0 for a point.

        glm::dvec3 nearestTo(const glm::dvec3& place) const
        {
            return first + std::clamp(glm::dot(place - first, along) * inverse, 0.0, 1.0) * along;
        }
    };

    /// What a segment is from the middle of the cell.
    struct Near
    {
        double square = 0.0; ///< Of its distance.
        std::uint32_t segment = 0;
    };

    struct Rival
    {
        double square = 0.0;
        glm::dvec3 place{0.0};
        std::array<double, 8> distances; ///< From the corners.
    };

    /// Those that are no more than `across` farther than the nearest one.
    void findNear(const std::uint32_t* from, std::size_t count, const glm::dvec3& middle,
                  double across)
    {
        _squares.resize(count);
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count; ++i)
        {
            const Line& line = _lines[from[i]];
            const glm::dvec3 away = middle - (_arePoints ? line.first : line.nearestTo(middle));
            _squares[i] = glm::dot(away, away);
            least = std::min(least, _squares[i]);
        }
        const double bound = std::sqrt(least) + across;
        _near.clear();
        for (std::size_t i = 0; i < count; ++i)
            if (_squares[i] <= bound * bound)
                _near.push_back({_squares[i], from[i]});
    }

    void addRival(const Near& near, const glm::dvec3& middle, double reach)
    {
        const Line& line = _lines[near.segment];
        Rival& rival = _rivals[_numRivals++];
        rival.square = near.square;
        rival.place = line.first;
        for (int i = 0; i < 8 && !_arePoints; ++i)
        {
            const glm::dvec3 corner =
                middle + reach * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
            rival.distances[std::size_t(i)] = glm::length(corner - line.nearestTo(corner));
        }
    }

    /// The difference of squared distances is linear.
    bool isBeatenByPoint(const Near& near, double reach) const
    {
        for (std::size_t i = 0; i < _numRivals; ++i)
        {
            const glm::dvec3 apart = glm::abs(_lines[near.segment].first - _rivals[i].place);
            if (near.square - _rivals[i].square >= 2.0 * reach * (apart.x + apart.y + apart.z))
                return true;
        }
        return false;
    }

    // The distance to a segment is not less than that to the plane through its point that is
    // nearest to the cell's middle, across the way there. This less the distance to the rival is
    // concave, so it has its least value at a corner.
    bool isBeatenByLine(const Near& near, const glm::dvec3& middle, double reach) const
    {
        if (_numRivals == 0 || !(near.square > 0.0))
            return false;
        const double distance = std::sqrt(near.square);
        const glm::dvec3 step =
            (middle - _lines[near.segment].nearestTo(middle)) * (reach / distance);
        std::array<double, 8> planes;
        for (int i = 0; i < 8; ++i)
            planes[std::size_t(i)] = distance + (i & 1 ? step.x : -step.x) +
                                     (i & 2 ? step.y : -step.y) + (i & 4 ? step.z : -step.z);
        return std::any_of(_rivals.begin(), _rivals.begin() + std::ptrdiff_t(_numRivals),
                           [&](const Rival& rival)
                           {
                               for (std::size_t i = 0; i < 8; ++i)
                                   if (planes[i] < rival.distances[i])
                                       return false;
                               return true;
                           });
    }

    std::vector<Line> _lines;
    bool _arePoints = true;
    std::vector<double> _squares;
    std::vector<Near> _near;
    std::array<Rival, MostRivals> _rivals;
    std::size_t _numRivals = 0;
};

/// A cube and the segments that may be the nearest ones in it.
struct Cell
{
    glm::ivec3 place{0};              ///< In cells of its level.
    int vain = 0;                     ///< Divisions in a row that have left as many candidates.
    std::size_t index = 0;            ///< Where it is stored, from GridLevel on.
    std::size_t first = 0, count = 0; ///< Of its level's candidates.
};

/// Fills the cells of one grid, level by level.
class Filler
{
public:
    /// What lies within `inner` wholly is never asked for.
    Filler(Candidates& candidates, const KeyCells::Root& root, const KeyCells::Root* inner,
           std::vector<std::int32_t>& cells, const std::atomic<bool>* isLeft)
        : _candidates(candidates), _root(root), _inner(inner), _cells(cells), _isLeft(isLeft),
          _mostCells(cells.size() + MostCells)
    {
    }

    /// Returns which segments may be the nearest ones outside of the grid: on the way from there
    /// to one it stays the nearest one, so it is a candidate where the way enters.
    std::vector<std::uint32_t> run(std::vector<std::uint32_t> segments)
    {
        std::vector<bool> isOuter(_candidates.size());
        _cells.resize(_cells.size() +
                      std::size_t(KeyCells::Grid * KeyCells::Grid * KeyCells::Grid));
        std::vector<Cell> cells(1);
        cells.front().count = segments.size();
        for (_level = 0; !cells.empty(); ++_level)
        {
            _half = std::ldexp(0.25 * _root.size, -_level);
            _next.clear();
            _nextChosen.clear();
            for (const Cell& cell : cells)
                settle(cell, segments.data() + cell.first, isOuter);
            std::swap(cells, _next);
            std::swap(segments, _nextChosen);
        }
        closeLists();
        segments.clear();
        for (std::size_t i = 0; i < isOuter.size(); ++i)
            if (isOuter[i])
                segments.push_back(static_cast<std::uint32_t>(i));
        return segments;
    }

private:
    static bool isWithin(const glm::dvec3& middle, double half, const KeyCells::Root& root)
    {
        const glm::dvec3 low = middle - half - root.low;
        return std::min({low.x, low.y, low.z}) >= 0.0 &&
               std::max({low.x, low.y, low.z}) + 2.0 * half <= root.size;
    }

    bool isAtTheSide(const Cell& cell) const
    {
        const int last = (1 << _level) - 1;
        for (int axis = 0; axis < 3; ++axis)
            if (cell.place[axis] == 0 || cell.place[axis] == last)
                return true;
        return false;
    }

    void settle(const Cell& cell, const std::uint32_t* segments, std::vector<bool>& isOuter)
    {
        const bool isCut = _looks > MostLooks || (_isLeft && *_isLeft);
        if ((_level == GridLevel || (_level < GridLevel && isCut)) && isAtTheSide(cell))
            for (std::size_t i = 0; i < cell.count; ++i)
                isOuter[segments[i]] = true;
        const bool isDone = isCut || cell.count <= Enough || cell.vain >= MostVain ||
                            _level == KeyCells::Levels || _cells.size() + 8 > _mostCells;
        if (_level < GridLevel ? !isCut : !isDone)
            return divide(cell, segments);
        if (_level >= GridLevel && cell.count > 0 && cell.count <= KeyCells::MaxCandidates)
        {
            _lists.push_back({cell.index, _listed.size(), cell.count});
            _listed.insert(_listed.end(), segments, segments + cell.count);
        } // else it is not told
    }

    void divide(const Cell& cell, const std::uint32_t* segments)
    {
        if (_level >= GridLevel)
        {
            _cells[cell.index] = static_cast<std::int32_t>(_cells.size());
            _cells.resize(_cells.size() + 8);
        }
        for (int octant = 0; octant < 8; ++octant)
        {
            Cell part;
            part.place = 2 * cell.place + glm::ivec3(octant & 1, octant >> 1 & 1, octant >> 2 & 1);
            part.first = _nextChosen.size();
            const glm::dvec3 middle = _root.low + (2.0 * glm::dvec3(part.place) + 1.0) * _half;
            if (_inner && isWithin(middle, _half, *_inner))
                continue;
            _looks += cell.count;
            _candidates.choose(segments, cell.count, middle, _half + Slack * _root.size,
                               _nextChosen);
            part.count = _nextChosen.size() - part.first;
            part.vain = part.count == cell.count ? cell.vain + 1 : 0;
            const glm::ivec3& at = part.place;
            part.index =
                _level >= GridLevel
                    ? std::size_t(_cells[cell.index]) + std::size_t(octant)
                    : std::size_t(_root.first) + // of the grid's level alone
                          std::size_t((at.z * KeyCells::Grid + at.y) * KeyCells::Grid + at.x);
            _next.push_back(part);
        }
    }

    void closeLists()
    {
        _cells.resize((_cells.size() + 3) / 4 * 4);
        for (const List& list : _lists)
        {
            const std::size_t fours = (list.count + 3) / 4;
            _cells[list.index] =
                -1 - static_cast<std::int32_t>(FoursOfList * (_cells.size() / 4) + fours - 1);
            const auto first = _listed.begin() + std::ptrdiff_t(list.first);
            _cells.insert(_cells.end(), first, first + std::ptrdiff_t(list.count));
            _cells.resize(_cells.size() + 4 * fours - list.count, _cells.back());
        }
    }

    struct List
    {
        std::size_t index, first, count;
    };

    Candidates& _candidates;
    const KeyCells::Root& _root;
    const KeyCells::Root* const _inner;
    std::vector<std::int32_t>& _cells;
    const std::atomic<bool>* const _isLeft;
    const std::size_t _mostCells;
    int _level = 0;
    double _half = 0.0; ///< Of the cells of the next level.
    std::size_t _looks = 0;
    std::vector<Cell> _next;
    std::vector<std::uint32_t> _nextChosen;
    std::vector<List> _lists;
    std::vector<std::uint32_t> _listed;
};

} // namespace

KeyCells::KeyCells(const std::vector<KeySegment>& segments, const std::atomic<bool>* isLeft)
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
    Candidates candidates(_segments);
    std::vector<std::uint32_t> outer(_segments.size());
    std::iota(outer.begin(), outer.end(), 0u);
    for (std::size_t i = 0; i < _roots.size(); ++i)
    {
        Root& root = _roots[i];
        root.size = (widest > 0.0 ? widest : 1.0) * (i == 0 ? InnerWidth : OuterWidth);
        root.low = 0.5 * (low + high) - 0.5 * root.size;
        root.first = static_cast<std::int32_t>(_cells.size());
        Filler filler(candidates, root, i > 0 ? &_roots[i - 1] : nullptr, _cells, isLeft);
        outer = filler.run(std::move(outer));
    }
}

// Right, as what has been left out of a cell is beaten everywhere in it by what it lists, or by
// what is beaten by that.
KeyCells KeyCells::without(const std::vector<std::uint32_t>& segments) const
{
    KeyCells left = *this;
    std::vector<bool> isGone(_segments.size());
    for (const std::uint32_t segment : segments)
        isGone[segment] = true;
    for (const Root& root : _roots)
        left.dropLists(root.first, Grid * Grid * Grid, isGone);
    return left;
}

void KeyCells::dropLists(std::int32_t first, int count, const std::vector<bool>& isGone)
{
    for (std::int32_t i = first; i < first + count; ++i)
    {
        std::int32_t& cell = _cells[std::size_t(i)];
        if (cell > 0)
            dropLists(cell, 8, isGone);
        if (cell >= 0)
            continue;
        const std::uint32_t list = static_cast<std::uint32_t>(-1 - cell);
        const auto from = _cells.begin() + std::ptrdiff_t(4 * (list / FoursOfList));
        if (std::any_of(from, from + std::ptrdiff_t(4 * (list % FoursOfList + 1)),
                        [&](std::int32_t segment) { return isGone[std::size_t(segment)]; }))
            cell = 0;
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
