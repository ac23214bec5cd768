// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/RectangleGrid.h>

#include <cstddef>
#include <limits>
#include <unordered_map>

namespace osgLabels
{

/// A label that wants a place on the screen.
struct DeclutterLabel
{
    Rectangle rectangle;   ///< One that is empty, not finite or outside of the view is not shown.
    double priority = 0.0; ///< The larger one wins; NaN counts as minus infinity.
    std::uint64_t key = 0; ///< Its own in all frames; equal priorities go by the smaller one.
};

struct DeclutterSettings
{
    float margin = 8.0f; ///< Pixels, 0 or more: the free space that a label needs to come.
    double hold = 1.0;   ///< Seconds, 0 or more, that a label stays as it is.
};

/// What is known of a label beside its rectangle.
struct DeclutterSight
{
    enum What : std::uint8_t
    {
        Unknown, ///< Not yet known: it comes where it pushes out nobody.
        Seen,
        Hidden ///< By something else: it is not shown and keeps no place.
    };
    What what = Seen;
    /// When something else changed the label, which holds it like a change of Declutter's.
    double since = -std::numeric_limits<double>::infinity();
};

/// Says which labels are shown, so that they do not lie over each other.
///
/// In the order of priority each label is shown that overlaps none shown before it. Of all
/// the frames but the first:
/// - While all labels and the view are as in the last frame nothing changes, whatever is known.
/// - A label comes where it has a margin of free space around it, once it has been hidden for the
///   hold, and when all weaker ones that it pushes out have been shown for the hold.
/// - A label goes when it is overlapped by a stronger one; within the hold when this is
///   by more than the margin, or more than a quarter of its width or height.
/// - A label that is hidden by something else goes at once, which nobody sees.
/// So labels that move by less than two margins a second relative to each other (and whose quarters
/// are no less than a margin) change once a second at most, and any label twice at most. Labels
/// that are new or were out of view for the hold have no past. A time that does not advance is a
/// cut: the frame is like a first one, but where it is as the last one.
///
/// For one thread at a time; 10,000 labels take at most 2 ms on a core of 2 GHz.
class OSGLABELS_EXPORT Declutter
{
public:
    explicit Declutter(const DeclutterSettings& settings = DeclutterSettings());

    /// For each label whether it is shown, 1 or 0, until the next call. `view` is the picture's
    /// size in pixels, `time` in seconds. Of labels with one key only the first has a past.
    /// `sights` are the labels', or none: all are seen.
    const std::vector<std::uint8_t>& update(const std::vector<DeclutterLabel>& labels,
                                            const glm::vec2& view, double time,
                                            const std::vector<DeclutterSight>& sights = {});
    /// When a label of the last call came or went; minus infinity: long ago.
    double getSince(std::size_t label) const { return _states[label].since; }
    /// The next call is a cut.
    void cut() { _time = std::numeric_limits<double>::quiet_NaN(); }

    std::size_t getNumShown() const { return _numShown; }

private:
    struct State
    {
        bool isShown = false;
        double since = -std::numeric_limits<double>::infinity();
    };

    bool isAsBefore(const std::vector<DeclutterLabel>& labels, const glm::vec2& view) const;
    void carryOver(const std::vector<DeclutterLabel>& labels);
    void sort(const std::vector<DeclutterLabel>& labels);
    void collectBefore();
    bool decide(std::uint32_t label, DeclutterSight::What what) const;
    bool isInView(const Rectangle& rectangle) const;
    bool isHeld(const State& state) const { return _time - state.since < _settings.hold; }

    DeclutterSettings _settings;
    std::vector<DeclutterLabel> _labels; ///< Of this frame, and then of the last one.
    std::vector<State> _states;
    std::vector<std::uint32_t> _order, _ranks; ///< Strongest first; the place in that order.
    std::vector<std::uint8_t> _shown;
    RectangleGrid _taken;  ///< By what is shown in this frame so far.
    RectangleGrid _before; ///< By what was shown in the last frame.
    /// Labels that left the list less than a hold after they changed.
    std::unordered_map<std::uint64_t, State> _gone;
    glm::vec2 _view{0.0f};
    double _time = std::numeric_limits<double>::quiet_NaN();
    bool _isCut = true;
    std::size_t _numShown = 0;
};

} // namespace osgLabels
