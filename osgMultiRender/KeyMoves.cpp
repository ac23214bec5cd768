// SPDX-License-Identifier: MIT
#include <osgMultiRender/KeyMoves.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace osgMultiRender
{

std::size_t KeyMoves::Hash::operator()(const KeySegment& segment) const
{
    std::size_t hash = 0;
    for (const glm::dvec3& end : {segment.first, segment.second})
        for (int axis = 0; axis < 3; ++axis)
            hash = hash * 0x9E3779B97F4A7C15u + std::hash<double>()(end[axis]);
    return hash ^ (hash >> 29);
}

void KeyMoves::take(const KeyPoints& points, std::shared_ptr<const KeyCells> cells)
{
    _made = points;
    _madeCells = std::move(cells);
    _gone.clear();
    _loose.clear();
    _cells = _madeCells;
    _numbers.clear();
    _numbers.reserve(getListed().size());
    for (const KeySegment& segment : getListed())
        _numbers.emplace(segment, static_cast<std::uint32_t>(_numbers.size()));
}

// Equal segments count as one: what is left of them measures the same.
void KeyMoves::compare(const KeyPoints& points)
{
    std::vector<bool> isThere(_numbers.size());
    _loose.clear();
    for (const KeySegment& segment : points.getTree().getSegments())
    {
        const auto found = _numbers.find(segment);
        if (found != _numbers.end())
            isThere[found->second] = true;
        else if (_loose.push_back(segment); _loose.size() > MostLoose)
            break;
    }
    std::vector<std::uint32_t> gone;
    for (std::uint32_t i = 0; i < getListed().size() && gone.size() <= MostGone; ++i)
        if (!isThere[_numbers.at(getListed()[i])])
            gone.push_back(i);
    if (_loose.size() > MostLoose || gone.size() > MostGone)
    {
        _cells = nullptr;
        return;
    }
    // A point that is dragged is gone from the same place all the time.
    if (!_cells || gone != _gone)
        _cells =
            gone.empty() ? _madeCells : std::make_shared<const KeyCells>(_madeCells->without(gone));
    _gone = std::move(gone);
}

void KeyMoves::update(const KeyPoints& points)
{
    const std::shared_ptr<const void> identity = points.getIdentity();
    const bool isGivenAgain = identity && identity == _given;
    _given = identity;
    if (isGivenAgain && identity == _made.getIdentity() && isOwn())
        return;
    const std::shared_ptr<const KeyCells> own = isGivenAgain ? points.findCells() : nullptr;
    if (own)
        take(points, own);
    else if (!identity || !_madeCells || points.getMode() != _made.getMode())
        _cells = nullptr;
    else if (!isGivenAgain)
        compare(points);
}

std::optional<double> KeyMoves::distance(const glm::dvec3& place) const
{
    std::optional<double> nearest = _cells ? _cells->distance(place) : std::nullopt;
    if (nearest)
        for (const KeySegment& segment : _loose)
            nearest = std::min(*nearest, segment.distance(place));
    return nearest;
}

} // namespace osgMultiRender
