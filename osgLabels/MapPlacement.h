// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FeatureTree.h>
#include <osgLabels/LabelSettings.h>

#include <osg/Matrixd>
#include <osg/Vec2d>

#include <cstdint>

namespace osgLabels
{

/// A map label in eye coordinates.
struct EyeLabel
{
    osg::Vec3d anchor;
    double priority = 0.0;
    std::uint64_t key = 0;        ///< The same from frame to frame.
    std::uint32_t identifier = 0; ///< Of its text.
    std::uint32_t style = 0;
    float width = 0.0f; ///< em
    FeatureTree::Name feature = FeatureTree::None;
    FeatureTree::Part part = FeatureTree::Scene; ///< Of a label by user values.
    FeatureTree::Range own;                      ///< Of these.
};

/// A rectangle in pixels of the window.
struct PixelBox
{
    double left = 0.0, bottom = 0.0, right = 0.0, top = 0.0;

    bool isEmpty() const { return !(left < right && bottom < top); }
    bool contains(double x, double y) const
    {
        return x >= left && x < right && y >= bottom && y < top;
    }
};

/// Where a map label lies in a picture.
struct PlacedLabel
{
    osg::Vec2d anchor; ///< Pixels of the window.
    osg::Vec2d center; ///< Of its text.
    double em = 0.0;   ///< Pixels.
    /// At which it is hidden, as MapFrame::distanceOf() says. Negative: nothing is before it.
    double distance = 0.0;
    PixelBox plate; ///< What it covers, without the leader line.
    PixelBox box;   ///< All that it draws into.
    const EyeLabel* label = nullptr;
};

/// What labels are placed in.
struct MapFrame
{
    osg::Matrixd projection;
    bool isParallel = false;
    bool isByDepth = false; ///< Where rays are parallel, of these or of others in the picture.
    PixelBox viewport;

    MapFrame(const osg::Matrixd& projection, const PixelBox& viewport, bool isByDepth = false);
    /// Of a point in eye coordinates: from the eye along the view, which is exact far away too, or
    /// window depth, which alone can be compared with that of parallel rays.
    double distanceOf(const osg::Vec3d& eye) const;
};

/// False for a label that no pixel of the viewport shows: behind the eye, beside the view, too
/// small to read, or with an anchor that is no number.
bool placeLabel(const EyeLabel& label, const MapFrame& frame, const LabelSettings& settings,
                PlacedLabel& placed);

} // namespace osgLabels
