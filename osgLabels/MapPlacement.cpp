// SPDX-License-Identifier: MIT
#include <osgLabels/MapPlacement.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// Larger letters look the same on any screen, and keep the numbers of shaders in range.
constexpr double largestEm = 1e6;

/// What edges may reach over what they bound, in pixels.
constexpr double edge = 1.0;

} // namespace

MapFrame::MapFrame(const osg::Matrixd& p, const PixelBox& v, bool byDepth)
    : projection(p), isParallel(p(0, 3) == 0.0 && p(1, 3) == 0.0 && p(2, 3) == 0.0),
      isByDepth(isParallel || byDepth), viewport(v)
{
}

double MapFrame::distanceOf(const osg::Vec3d& eye) const
{
    const osg::Vec4d clip = osg::Vec4d(eye, 1.0) * projection;
    return isByDepth ? 0.5 + 0.5 * clip.z() / clip.w() : clip.w();
}

bool placeLabel(const EyeLabel& label, const MapFrame& frame, const LabelSettings& settings,
                PlacedLabel& placed)
{
    const osg::Vec4d clip = osg::Vec4d(label.anchor, 1.0) * frame.projection;
    if (!std::isfinite(clip.length2()) || !(clip.w() > 0.0))
        return false;
    const PixelBox& v = frame.viewport;
    const double width = v.right - v.left, height = v.top - v.bottom;
    placed.anchor = osg::Vec2d(v.left + (0.5 + 0.5 * clip.x() / clip.w()) * width,
                               v.bottom + (0.5 + 0.5 * clip.y() / clip.w()) * height);
    placed.em = settings.mapSize;
    if (settings.mapWorld > 0.0f)
        placed.em =
            std::min(settings.mapWorld * 0.5 * height * std::abs(frame.projection(1, 1)) / clip.w(),
                     largestEm);
    if (!(placed.em > 0.5 * settings.readable) || !std::isfinite(placed.anchor.length2()))
        return false;
    const double halfWidth = (0.5 * double(label.width) + LabelSettings::MapPadX) * placed.em;
    const double halfHeight = (0.5 + LabelSettings::MapPadY) * placed.em;
    placed.center = placed.anchor;
    if (settings.mapLeader > 0.0f)
        placed.center.y() += settings.mapLeader + halfHeight;
    const osg::Vec2d& c = placed.center;
    placed.plate = {c.x() - halfWidth, c.y() - halfHeight, c.x() + halfWidth, c.y() + halfHeight};
    placed.box = {placed.plate.left - edge, std::min(placed.plate.bottom, placed.anchor.y()) - edge,
                  placed.plate.right + edge, placed.plate.top + edge};
    if (placed.box.right <= v.left || placed.box.left >= v.right || placed.box.top <= v.bottom ||
        placed.box.bottom >= v.top)
        return false;
    osg::Vec3d at = label.anchor;
    const double away = frame.isParallel ? 0.0 : at.length();
    if (frame.isParallel)
        at.z() += settings.mapOffset;
    else if (away > 0.0)
        at *= 1.0 - settings.mapOffset / away;
    const bool reachesEye = !frame.isParallel && settings.mapOffset >= away;
    placed.distance = reachesEye ? -1.0 : frame.distanceOf(at);
    placed.label = &label;
    return true;
}

} // namespace osgLabels
