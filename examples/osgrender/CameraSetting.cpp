// SPDX-License-Identifier: MIT
#include "CameraSetting.h"

#include "Parse.h"

#include <osgDB/FileUtils>
#include <osgDB/fstream>
#include <osgGA/TrackballManipulator>

#include <set>
#include <sstream>

namespace osgrender
{

namespace
{

bool parseRange(const std::string& text, double low, double high, double& value)
{
    return parseNumber(text, value) && value >= low && value <= high;
}

/// Reads one "key:value" into the setting. The message says what the value has to be.
bool parsePart(const std::string& key, const std::string& value, CameraSetting& setting,
               std::string& error)
{
    osg::Vec3d vector;
    double number = 0.0;
    const bool isVector = key == "eye" || key == "center" || key == "up";
    if (isVector && !parseVector(value, vector))
        error = key + " takes three numbers x,y,z";
    else if (key == "eye")
        setting.eye = vector;
    else if (key == "center")
        setting.center = vector;
    else if (key == "up")
        setting.up = vector;
    else if (key == "fov")
    {
        if (parseNumber(value, number) && number > 0.0 && number < 180.0)
            setting.fovDegrees = number;
        else
            error = "fov takes degrees above 0 and below 180";
    }
    else if (key == "turn")
    {
        if (!parseRange(value, -360.0, 360.0, setting.turnDegrees))
            error = "turn takes degrees from -360 to 360";
    }
    else if (key == "lift")
    {
        if (!parseRange(value, -89.0, 89.0, setting.liftDegrees))
            error = "lift takes degrees from -89 to 89";
    }
    else if (key == "zoom")
    {
        if (!parseRange(value, 0.001, 1000.0, setting.zoom))
            error = "zoom takes a factor from 0.001 to 1000";
    }
    else
        error = "unknown part '" + key + "' (known: home eye center up fov turn lift zoom)";
    return error.empty();
}

bool isParallel(const osg::Vec3d& a, const osg::Vec3d& b)
{
    return (a ^ b).length2() <= 1e-20 * a.length2() * b.length2();
}

std::string check(const CameraSetting& setting, const std::set<std::string>& seen)
{
    if (!setting.home && !setting.eye)
        return "either home or eye:x,y,z is needed";
    if (setting.home && (setting.eye || setting.center || seen.count("up")))
        return "home chooses eye, center and up itself; give turn, lift, zoom or fov";
    if (!setting.home && (seen.count("turn") || seen.count("lift") || seen.count("zoom")))
        return "turn, lift and zoom go with home";
    if (setting.up.length2() == 0.0)
        return "up has length 0";
    if (setting.eye && setting.center && *setting.eye == *setting.center)
        return "eye and center are the same point";
    if (setting.eye && setting.center && isParallel(*setting.center - *setting.eye, setting.up))
        return "up points along the view direction";
    return std::string();
}

/// The eye that osgviewer's trackball takes at home, turned, lifted and moved as asked for.
void aimHome(osg::Camera& camera, osg::Node& scene, const CameraSetting& setting)
{
    osg::ref_ptr<osgGA::TrackballManipulator> trackball = new osgGA::TrackballManipulator;
    trackball->setNode(&scene);
    trackball->computeHomePosition(&camera, false);
    osg::Vec3d eye, center, up;
    trackball->getHomePosition(eye, center, up);

    const osg::Quat turn(osg::DegreesToRadians(setting.turnDegrees), osg::Vec3d(0.0, 0.0, 1.0));
    osg::Vec3d arm = turn * (eye - center);
    const osg::Vec3d right = (turn * up) ^ arm;
    arm = osg::Quat(-osg::DegreesToRadians(setting.liftDegrees), right) * arm;
    camera.setViewMatrixAsLookAt(center + arm / setting.zoom, center, up);
}

} // namespace

bool parseCamera(const std::string& text, CameraSetting& setting, std::string& error)
{
    setting = CameraSetting();
    setting.home = false;
    std::set<std::string> seen;
    for (const std::string& part : split(text, ';'))
    {
        const std::size_t colon = part.find(':');
        const std::string key = part.substr(0, colon);
        if (!seen.insert(key).second)
            error = "'" + key + "' is given twice";
        else if (part == "home")
            setting.home = true;
        else if (colon == std::string::npos)
            error = "'" + part + "' is neither home nor key:value";
        else
            parsePart(key, part.substr(colon + 1), setting, error);
        if (!error.empty())
            break;
    }
    if (error.empty())
        error = check(setting, seen);
    if (!error.empty())
        error = "--camera '" + text + "': " + error;
    return error.empty();
}

bool aim(osg::Camera& camera, osg::Node& scene, const CameraSetting& setting, std::string& error)
{
    if (setting.fovDegrees)
    {
        double fov, aspect, zNear, zFar;
        camera.getProjectionMatrixAsPerspective(fov, aspect, zNear, zFar);
        camera.setProjectionMatrixAsPerspective(*setting.fovDegrees, aspect, zNear, zFar);
    }
    if (setting.home)
    {
        aimHome(camera, scene, setting);
        return true;
    }
    const osg::Vec3d center =
        setting.center ? *setting.center : osg::Vec3d(scene.getBound().center());
    const osg::Vec3d direction = center - *setting.eye;
    if (direction.length2() == 0.0 || isParallel(direction, setting.up))
    {
        error = "--camera: the centre of the scene lies at the eye or along up; give center:x,y,z";
        return false;
    }
    camera.setViewMatrixAsLookAt(*setting.eye, center, setting.up);
    return true;
}

std::string describeCamera(const osg::Camera& camera, double distance)
{
    osg::Vec3d eye, center, up;
    camera.getViewMatrixAsLookAt(eye, center, up, distance > 0.0 ? distance : 1.0);
    double fov = 0.0, aspect = 0.0, zNear = 0.0, zFar = 0.0;
    std::ostringstream text;
    const auto write = [&text](const char* name, const osg::Vec3d& v)
    { text << name << v.x() << "," << v.y() << "," << v.z() << ";"; };
    write("eye:", eye);
    write("center:", center);
    write("up:", up);
    if (camera.getProjectionMatrixAsPerspective(fov, aspect, zNear, zFar))
        text << "fov:" << fov;
    return text.str();
}

osg::ref_ptr<osg::AnimationPath> readCameraPath(const std::string& file, std::string& error)
{
    // Not AnimationPath::read(), which never ends on text that is no number.
    osg::ref_ptr<osg::AnimationPath> path = new osg::AnimationPath;
    path->setLoopMode(osg::AnimationPath::NO_LOOPING);
    const std::string found = osgDB::findDataFile(file);
    osgDB::ifstream stream(found.c_str());
    double n[8];
    while (stream >> n[0] >> n[1] >> n[2] >> n[3] >> n[4] >> n[5] >> n[6] >> n[7])
        path->insert(n[0], osg::AnimationPath::ControlPoint(osg::Vec3d(n[1], n[2], n[3]),
                                                            osg::Quat(n[4], n[5], n[6], n[7])));
    if (found.empty())
        error = "camera path '" + file + "' is not there";
    else if (path->empty() || !stream.eof())
        error = "camera path '" + file + "': line " +
                std::to_string(path->getTimeControlPointMap().size() + 1) +
                " is not a time, a position and a rotation (8 numbers)";
    return error.empty() ? path : nullptr;
}

void follow(osg::Camera& camera, const osg::AnimationPath& path, double seconds)
{
    osg::AnimationPath::ControlPoint point;
    path.getInterpolatedControlPoint(path.getFirstTime() + seconds, point);
    osg::Matrixd view;
    point.getInverse(view);
    camera.setViewMatrix(view);
}

} // namespace osgrender
