// SPDX-License-Identifier: MIT
#include <osgPagedTexture/EyeMotion.h>

#include <osg/Quat>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

constexpr double MemorySeconds = 0.1; ///< Frames of viewers come unevenly.
constexpr double Pi = 3.14159265358979323846;

/// Axis times angle.
osg::Vec3d turnOf(const osg::Quat& rotation)
{
    const double w = std::min(1.0, std::abs(rotation.w()));
    const osg::Vec3d axis(rotation.x(), rotation.y(), rotation.z());
    const double length = axis.length();
    const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
    return length > 1e-12 ? axis * (sign * 2.0 * std::acos(w) / length) : osg::Vec3d();
}

} // namespace

void EyeMotion::see(const osg::Matrixd& toEye, double time)
{
    const double passed = time - _time;
    if (_isKnown && passed > 0.0)
    {
        const osg::Vec3d place = osg::Vec3d() * osg::Matrixd::inverse(toEye);
        const osg::Vec3d before = osg::Vec3d() * osg::Matrixd::inverse(_toEye);
        const osg::Vec3d turn =
            turnOf((osg::Matrixd::inverse(_toEye) * toEye).getRotate()) / passed;
        const double share = 1.0 - std::exp(-passed / MemorySeconds);
        _velocity += ((place - before) / passed - _velocity) * share;
        _turn += (turn - _turn) * share;
    }
    if (!_isKnown || passed > 0.0)
        _time = time;
    _isKnown = true;
    _toEye = toEye;
}

osg::Vec3d EyeMotion::placeAfter(double seconds) const
{
    return osg::Matrixd::transform3x3(_velocity * seconds, _toEye);
}

osg::Matrixd EyeMotion::after(double seconds) const
{
    const double speed = _turn.length();
    const double angle = std::min(speed * seconds, Pi);
    const osg::Matrixd moved = osg::Matrixd::translate(-placeAfter(seconds));
    return angle > 0.0 ? moved * osg::Matrixd::rotate(angle, _turn / speed) : moved;
}

bool EyeMotion::isStill() const
{
    // A millionth of a unit, or of a radian, brings nothing into view.
    return _velocity.length2() < 1e-12 && _turn.length2() < 1e-12;
}

} // namespace osgPagedTexture
