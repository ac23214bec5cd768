// SPDX-License-Identifier: MIT
// Key points by the mouse. Not installed.
#pragma once

#include <osg/Vec3d>

#include <optional>

namespace osgGA
{
class EventVisitor;
class GUIEventAdapter;
} // namespace osgGA

namespace osgMultiRender
{

class MixedScene;

/// The point that follows the mouse. Used by the thread of events alone.
///
/// Ctrl and the left button take hold of a marker that is shown: its point follows in the plane
/// through it that is parallel to the screen. Shift and the left button take a marker's point away,
/// or make one on the surface of the scene. What hits neither is left to the viewer.
class MixDrag
{
public:
    /// Whether it was meant for key points.
    bool answer(MixedScene& scene, const osgGA::GUIEventAdapter& event,
                osgGA::EventVisitor& visitor);

private:
    bool press(MixedScene& scene, const osgGA::GUIEventAdapter& event,
               osgGA::EventVisitor& visitor);

    struct Held
    {
        std::size_t point = 0;
        osg::Vec3d place; ///< Of the point in normalised device coordinates, when it was taken.
        double x = 0.0, y = 0.0; ///< Of the mouse then.
    };
    std::optional<Held> _held;
    bool _swallows = false; ///< The button's release belongs to a press that was answered.
};

/// The surface of the scene under the mouse, in the coordinates of the key points.
std::optional<osg::Vec3d> placeUnder(MixedScene& scene, const osgGA::GUIEventAdapter& event,
                                     osgGA::EventVisitor& visitor);

void addPoint(MixedScene& scene, const osg::Vec3d& place);

} // namespace osgMultiRender
