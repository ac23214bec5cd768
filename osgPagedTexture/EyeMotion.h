// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <osg/Matrixd>

namespace osgPagedTexture
{

/// How an eye moves and turns, as the mean of the last tenth of a second: where it will be if it
/// goes on so.
class OSGPAGEDTEXTURE_EXPORT EyeMotion
{
public:
    /// The eye of a frame: the matrix from the scene to it, of rotation and translation, and the
    /// time in seconds. Times that do not grow count as no time.
    void see(const osg::Matrixd& toEye, double time);

    /// From coordinates of the eye as it was seen last to those of the eye in `seconds`. It turns
    /// by half a circle at most.
    osg::Matrixd after(double seconds) const;

    /// Where the eye will be, in coordinates of the eye as it was seen last.
    osg::Vec3d placeAfter(double seconds) const;

    bool isStill() const;

private:
    bool _isKnown = false;
    double _time = 0.0;
    osg::Matrixd _toEye;
    osg::Vec3d _velocity; ///< A second, in the scene.
    osg::Vec3d _turn;     ///< Axis times radians a second, in the eye.
};

} // namespace osgPagedTexture
