// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Declutter.h>
#include <osgLabels/MapFeedback.h>
#include <osgLabels/MapPlacement.h>

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/StateSet>

#include <atomic>
#include <memory>
#include <unordered_map>

namespace osgLabels
{

/// What a view is seen from: it moves where this differs from the last frame's.
struct MapCamera
{
    osg::Matrixd groupToEye;
    std::vector<osg::Matrixd> projections;
    PixelBox viewport;

    bool operator==(const MapCamera& other) const;
};

/// What one view remembers of its map labels from frame to frame; in its draw thread.
///
/// A label changes once a second at most, also when it leaves the view and comes back within, and
/// only while the view moves, or, where it rests, when what is seen of the label has changed.
/// What is held back when the view comes to rest is dropped until it moves again, so that where
/// view and scene rest nothing changes. A time that does not advance is a cut, and so is a jump of
/// the view: the picture stands for itself then.
class MapMemory : public osg::Referenced
{
public:
    MapMemory() : osg::Referenced(true) {}

    /// What a label has been.
    struct Past
    {
        std::uint32_t last = 0; ///< Index of its state in the last frame plus 1; 0: none.
        bool isGone = false;    ///< Out of view; it keeps its state for a while.
    };

    /// A frame begins. `labels` lie in an order that changes little.
    void begin(osg::State& state, const std::vector<PlacedLabel>& labels, const MapCamera& camera,
               double time);
    bool isCut() const { return _isCut; }
    /// Whether it has GL objects of that context.
    bool isOf(unsigned int contextID) const { return _contextID == contextID; }
    bool isMoving() const { return _isMoving; }
    /// Of the labels, and then of those that are gone.
    const std::vector<Past>& getPasts() const { return _pasts; }

    /// Which labels are shown, so that they don't lie over each other. Those that are known to be
    /// hidden keep no place. `isTested`: their states are found in this frame; in a cut, they have
    /// been found.
    const std::vector<std::uint8_t>& declutter(osg::State& state,
                                               const std::vector<PlacedLabel>& labels,
                                               const PixelBox& view, bool isTested);
    /// Seconds since decluttering changed a label, by its index.
    float getAge(std::size_t index) const;

    /// Binds the framebuffer for the states of this frame; a label's is at its index in rows of
    /// RowLength. Sets uniform and texture of the last ones on the unit.
    void bind(osg::State& state, osg::StateSet& stateSet, int unit);
    const osg::StateAttribute* getStates() const { return _textures[_current].get(); }
    osg::Vec2 getSize() const { return osg::Vec2(float(RowLength), float(_rows)); }
    /// Hands the states of this frame, which are bound, to a later one.
    void startFeedback(osg::State& state, const std::vector<PlacedLabel>& labels);
    /// What becomes of the label with an index in this frame. Leaves framebuffers bound.
    unsigned int read(osg::State& state, std::size_t index);
    /// Seconds since the first frame with states.
    float getTime() const { return float(_time - _start); }

    static constexpr int RowLength = 1024;
    static constexpr float Hold = 1.0f; ///< Seconds that a label stays as it is.

protected:
    ~MapMemory() override = default;

private:
    /// A label of the last frame.
    struct Last
    {
        std::uint64_t key;
        osg::Vec2d anchor;
        double seen; ///< Time when it was last in view.
    };
    void forget(osg::State& state, double time);
    bool isJump(const std::vector<PlacedLabel>& labels, const PixelBox& view) const;
    void keepGone(std::vector<Last>& now);
    void findSights(osg::State& state, const std::vector<PlacedLabel>& labels, bool isTested);
    void attach(osg::State& state);

    Declutter _declutter;
    std::vector<DeclutterSight> _sights;
    std::unordered_map<std::uint64_t, MapFeedback::State> _fed; ///< By key.
    MapFeedback _feedback;
    std::unique_ptr<osgMultiRender::Framebuffer> _framebuffer;
    osg::ref_ptr<osgMultiRender::TargetTexture> _textures[2];
    int _current = 0, _rows = 0;
    std::atomic<unsigned int> _contextID{~0u};
    double _time = 0.0, _start = 0.0;
    bool _isCut = true, _isMoving = true;
    MapCamera _camera;
    std::vector<Past> _pasts;
    std::vector<Last> _last;                                   ///< By index.
    std::size_t _numLast = 0;                                  ///< Those in view.
    std::unordered_map<std::uint64_t, std::uint32_t> _indices; ///< By key.
};

} // namespace osgLabels
