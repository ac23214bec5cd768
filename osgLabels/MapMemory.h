// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Declutter.h>
#include <osgLabels/MapPlacement.h>

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/StateSet>

#include <memory>
#include <unordered_map>

namespace osgLabels
{

/// What one view remembers of its map labels from frame to frame; in its draw thread.
///
/// A time that does not advance is a cut: each picture stands for itself then.
class MapMemory : public osg::Referenced
{
public:
    MapMemory() : osg::Referenced(true) {}

    /// Leaves labels that are shown.
    void declutter(std::vector<PlacedLabel>& labels, const PixelBox& view, double time);

    /// A frame begins whose labels have states: each what becomes of it as a whole. Returns for
    /// each label its index in the last frame plus 1; 0 for new ones.
    std::vector<std::uint32_t> begin(osg::State& state, const std::vector<PlacedLabel>& labels,
                                     double time);
    /// Binds the framebuffer for the states of this frame; a label's is at its index in rows of
    /// RowLength. Sets uniform and texture of the last ones on the unit.
    void bind(osg::State& state, osg::StateSet& stateSet, int unit);
    const osg::StateAttribute* getStates() const { return _textures[_current].get(); }
    osg::Vec2 getSize() const { return osg::Vec2(float(RowLength), float(_rows)); }
    /// What becomes of the label with an index in this frame. Leaves framebuffers bound.
    unsigned int read(osg::State& state, std::size_t index);
    /// Seconds since the first frame with states.
    float getTime() const { return float(_time - _start); }

    static constexpr int RowLength = 1024;

protected:
    ~MapMemory() override = default;

private:
    Declutter _declutter;
    std::unique_ptr<osgMultiRender::Framebuffer> _framebuffer;
    osg::ref_ptr<osgMultiRender::TargetTexture> _textures[2];
    int _current = 0, _rows = 0;
    unsigned int _contextID = 0;
    double _time = 0.0, _start = 0.0;
    std::unordered_map<std::uint64_t, std::uint32_t> _indices; ///< By key, of the last frame.
};

} // namespace osgLabels
