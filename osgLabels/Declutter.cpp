// SPDX-License-Identifier: MIT
#include <osgLabels/Declutter.h>

#include <osgLabels/KeyIndex.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace osgLabels
{

namespace
{

Rectangle grown(const Rectangle& rectangle, const glm::vec2& by)
{
    return {rectangle.low - by, rectangle.high + by};
}

/// What a label takes: a pixel at least, so that no cell of a grid has room for many.
Rectangle spaceOf(const Rectangle& rectangle)
{
    return grown(rectangle, 0.5f * glm::max(1.0f - (rectangle.high - rectangle.low), 0.0f));
}

/// What labels are sorted by, in one place: strongest first.
struct Strength
{
    double priority;
    std::uint64_t key;
    std::uint32_t label;

    bool operator<(const Strength& other) const
    {
        if (priority != other.priority)
            return priority > other.priority;
        return key != other.key ? key < other.key : label < other.label;
    }
};

} // namespace

Declutter::Declutter(const DeclutterSettings& settings) : _settings(settings) {}

const std::vector<std::uint8_t>& Declutter::update(const std::vector<DeclutterLabel>& labels,
                                                   const glm::vec2& view, double time,
                                                   const std::vector<DeclutterSight>& sights)
{
    const bool isRest = isAsBefore(labels, view);
    _isCut = !(time > _time);
    _time = time;
    if (isRest && !(_isCut && !sights.empty()))
        return _shown;
    carryOver(labels);
    _labels = labels;
    _view = view;
    _shown.assign(labels.size(), 0);
    _numShown = 0;
    if (!(view.x > 0.0f && view.y > 0.0f))
        return _shown;
    collectBefore();
    _taken.reset(view);
    for (const std::uint32_t label : _order)
    {
        State& state = _states[label];
        const DeclutterSight sight = label < sights.size() ? sights[label] : DeclutterSight();
        if (!isInView(_labels[label].rectangle))
        {
            if (!isHeld(state))
                state = State();
            continue;
        }
        if (state.isShown)
            state.since = std::max(state.since, sight.since);
        const bool isShown = decide(label, sight.what);
        if (isShown != state.isShown && !_isCut)
            state.since = time;
        state.isShown = isShown;
        _shown[label] = isShown;
        _numShown += isShown;
        if (isShown)
            _taken.add(spaceOf(_labels[label].rectangle), label);
    }
    return _shown;
}

bool Declutter::isAsBefore(const std::vector<DeclutterLabel>& labels, const glm::vec2& view) const
{
    // Bit by bit: what is not a number is like itself, too.
    static_assert(sizeof(DeclutterLabel) == sizeof(Rectangle) + 16, "padding has no value");
    return view == _view && labels.size() == _labels.size() &&
           (labels.empty() ||
            std::memcmp(labels.data(), _labels.data(), labels.size() * sizeof(labels[0])) == 0);
}

void Declutter::carryOver(const std::vector<DeclutterLabel>& labels)
{
    const auto isSameLabel = [](const DeclutterLabel& a, const DeclutterLabel& b)
    { return a.key == b.key && a.priority == b.priority; };
    if (!std::equal(labels.begin(), labels.end(), _labels.begin(), _labels.end(), isSameLabel))
    {
        KeyIndex index(_labels.size());
        for (std::size_t i = 0; i < _labels.size(); ++i)
            index.add(_labels[i].key, static_cast<std::uint32_t>(i));
        std::vector<State> states(labels.size());
        std::vector<bool> isTaken(_labels.size());
        for (std::size_t i = 0; i < labels.size(); ++i)
        {
            const std::uint32_t last = index.take(labels[i].key);
            if (last != KeyIndex::None)
            {
                states[i] = _states[last];
                isTaken[last] = true;
            }
            else if (const auto gone = _gone.find(labels[i].key); gone != _gone.end())
            {
                states[i] = gone->second;
                _gone.erase(gone);
            }
        }
        for (std::size_t i = 0; i < _labels.size(); ++i)
            if (!isTaken[i] && isHeld(_states[i]))
                _gone[_labels[i].key] = _states[i];
        for (auto each = _gone.begin(); each != _gone.end();)
            each = isHeld(each->second) ? std::next(each) : _gone.erase(each);
        _states = std::move(states);
        sort(labels);
    }
    if (_isCut)
    {
        std::fill(_states.begin(), _states.end(), State());
        _gone.clear();
    }
}

void Declutter::sort(const std::vector<DeclutterLabel>& labels)
{
    std::vector<Strength> strengths(labels.size());
    for (std::uint32_t i = 0; i < labels.size(); ++i)
    {
        const double priority = labels[i].priority;
        // A number, or the order would be none.
        strengths[i] = {std::isnan(priority) ? -std::numeric_limits<double>::infinity() : priority,
                        labels[i].key, i};
    }
    std::sort(strengths.begin(), strengths.end());
    _order.resize(labels.size());
    std::transform(strengths.begin(), strengths.end(), _order.begin(),
                   [](const Strength& strength) { return strength.label; });
    _ranks.resize(labels.size());
    for (std::size_t i = 0; i < _order.size(); ++i)
        _ranks[_order[i]] = static_cast<std::uint32_t>(i);
}

void Declutter::collectBefore()
{
    _before.reset(_view);
    for (std::size_t i = 0; i < _labels.size(); ++i)
        if (_states[i].isShown && isInView(_labels[i].rectangle))
            _before.add(spaceOf(_labels[i].rectangle), static_cast<std::uint32_t>(i));
}

bool Declutter::decide(std::uint32_t label, DeclutterSight::What what) const
{
    if (what == DeclutterSight::Hidden)
        return false;
    const Rectangle rectangle = spaceOf(_labels[label].rectangle);
    const State& state = _states[label];
    const auto always = [](std::uint32_t) { return true; };
    if (_isCut)
        return !_taken.any(rectangle, always);
    const glm::vec2 margin(_settings.margin);
    if (state.isShown)
    {
        const glm::vec2 give = glm::min(margin, 0.25f * (rectangle.high - rectangle.low));
        return !_taken.any(isHeld(state) ? grown(rectangle, -give) : rectangle, always);
    }
    const std::uint32_t rank = _ranks[label];
    const auto isKept = [&](std::uint32_t other)
    { return what == DeclutterSight::Unknown || (_ranks[other] > rank && isHeld(_states[other])); };
    return !isHeld(state) && !_taken.any(grown(rectangle, margin), always) &&
           !_before.any(rectangle, isKept);
}

bool Declutter::isInView(const Rectangle& rectangle) const
{
    const glm::vec2 size =
        rectangle.high - rectangle.low; // infinite where a corner is or overflows
    return size.x > 0.0f && size.y > 0.0f && std::isfinite(size.x) && std::isfinite(size.y) &&
           rectangle.overlaps({glm::vec2(0.0f), _view});
}

} // namespace osgLabels
