// SPDX-License-Identifier: MIT
#pragma once

#include <osg/AnimationPath>
#include <osg/Camera>
#include <osg/Node>
#include <osg/Vec3d>

#include <optional>
#include <string>

namespace osgrender
{

/// Where a picture is taken from, as --camera says it.
struct CameraSetting
{
    bool home = true;                 ///< From osgviewer's home position.
    std::optional<osg::Vec3d> eye;    ///< World coordinates; set unless home.
    std::optional<osg::Vec3d> center; ///< World coordinates; else the centre of the scene.
    osg::Vec3d up = osg::Vec3d(0.0, 0.0, 1.0);
    std::optional<double> fovDegrees; ///< Vertical, above 0 and below 180; else osgviewer's.
    double turnDegrees = 0.0;         ///< Home only: about the scene's z axis, to the right.
    double liftDegrees = 0.0;         ///< Home only: upwards, -89 to 89.
    double zoom = 1.0;                ///< Home only: 2 halves the distance to the scene's centre.
};

/// Reads "home", "home;turn:30;lift:20;zoom:1.5" or "eye:x,y,z;center:x,y,z;up:x,y,z;fov:degrees".
/// Returns false and fills `error` on an unknown or repeated part, a number that is none, a view
/// direction or up vector of length 0, or an up vector along the view direction.
bool parseCamera(const std::string& text, CameraSetting& setting, std::string& error);

/// Aims the camera, whose viewport and projection are set. Returns false and fills `error` when the
/// eye is the centre of the scene.
bool aim(osg::Camera& camera, osg::Node& scene, const CameraSetting& setting, std::string& error);

/// Where a camera is, as parseCamera() reads it, to six digits; center is `distance` before the
/// eye.
std::string describeCamera(const osg::Camera& camera, double distance);

/// Reads OSG's `.path` (time, position, rotation a line, as osgviewer's z key saves it).
osg::ref_ptr<osg::AnimationPath> readCameraPath(const std::string& file, std::string& error);

/// Puts the camera where the path is `seconds` after its start; it stays at the path's end.
void follow(osg::Camera& camera, const osg::AnimationPath& path, double seconds);

} // namespace osgrender
