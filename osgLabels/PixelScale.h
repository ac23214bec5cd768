// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/Matrixd>
#include <osg/Plane>
#include <osg/RenderInfo>

namespace osgLabels
{

/// How many pixels a length of a drawable's local coordinates has in the view that is drawn.
class OSGLABELS_EXPORT PixelScale
{
public:
    /// `smallest`: radius in pixels under which nothing is drawn.
    PixelScale(const osg::Matrixd& modelView, const osg::Matrixd& projection, double width,
               double height, double smallest);
    /// Of the matrices and the viewport that are applied. The small-feature rule is the camera's.
    static PixelScale of(osg::RenderInfo& renderInfo);

    /// Pixels a unit at eye depth z, where that is -1 one before the eye. Infinite at the eye and
    /// behind it in perspective.
    double at(double z) const;
    /// Eye depth of a local point.
    double depthOf(const osg::Vec3d& point) const { return point * _depth + _depthOffset; }
    /// Eye units a local unit, along the axis where that is most.
    double eyeScale() const { return _eyeScale; }
    /// The eye in local coordinates is so close to the sphere that its parts differ much in size.
    bool isNear(const osg::Vec3d& center, double radius) const;
    /// Whether all of a sphere, in local coordinates, lies beside the view or behind the eye.
    bool isOutside(const osg::Vec3d& center, double radius) const;
    /// Objects of a smaller radius, in pixels, are not drawn; OSG's small-feature rule.
    double getSmallest() const { return _smallest; }

private:
    osg::Matrixd _modelView;
    osg::Plane _planes[5]; ///< Left, right, bottom, top, eye; in local coordinates.
    osg::Vec3d _depth;
    double _depthOffset, _eyeScale, _pixels, _perZ, _atZero, _smallest;
};

} // namespace osgLabels
