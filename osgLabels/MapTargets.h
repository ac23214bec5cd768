// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/StateSet>

namespace osgLabels
{

struct MapLayout
{
    int width = 0, height = 0; ///< Pixels, to the upper right corner of the viewport.
    int actions = 1;           ///< Of MapAction, those in use.
    int next = 0;              ///< Layers behind the nearest, for each action.

    bool operator==(const MapLayout& other) const
    {
        return width == other.width && height == other.height && actions == other.actions &&
               next == other.next;
    }
};

/// What stands before map labels in one view, in one graphics context: for each action the nearest
/// face and, where needed, the nearest ones of other features. One sample a pixel, whatever the
/// view has: numbers of features can't be averaged.
class MapTargets : public osg::Referenced
{
public:
    using Layout = MapLayout;

    enum Unit
    {
        NearUnit = 0,
        NextUnit = 1
    };

    MapTargets(unsigned int contextID, const MapLayout& layout);

    const MapLayout& getLayout() const { return _layout; }
    std::size_t getBytes() const;

    /// Binds the framebuffer for the nearest faces of an action, or for one of the layers behind, 0
    /// for the nearest: location 0 a colour that nobody reads but the alpha test, 1 number of the
    /// feature and distance.
    void bind(osg::State& state, int action, int next);
    /// Number and distance at a pixel of the window; 0 outside. Leaves framebuffers bound.
    struct Texel
    {
        std::uint32_t number = 0;
        float distance = 0.0f;
    };
    Texel read(osg::State& state, int action, int next, int x, int y);

    const osg::StateAttribute* getNear() const { return _near.get(); }
    /// Null without such layers. Each has all actions.
    const osg::StateAttribute* getNext() const { return _next.get(); }

protected:
    ~MapTargets() override = default;

private:
    const MapLayout _layout;
    osgMultiRender::Framebuffer _framebuffer;
    osg::ref_ptr<osgMultiRender::TargetTexture> _near, _next, _color, _depth;
};

} // namespace osgLabels
