// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixDrag.h>

#include <osgMultiRender/MixedScene.h>

#include <osg/ApplicationUsage>
#include <osg/Transform>
#include <osg/View>
#include <osg/Viewport>
#include <osgGA/EventVisitor>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

namespace
{

using Event = osgGA::GUIEventAdapter;

/// How near to a marker's middle the mouse has to be.
constexpr double GrabPixels = 12.0;

[[maybe_unused]] const bool isInUsage = []
{
    auto* usage = osg::ApplicationUsage::instance();
    usage->addKeyboardMouseBinding("Ctrl+left drag", "Moves a key point that is shown");
    usage->addKeyboardMouseBinding(
        "Shift+left click", "A new key point on the surface, or takes one that is shown away");
    return true;
}();

const osg::Camera* cameraOf(osgGA::EventVisitor& visitor)
{
    auto* view = dynamic_cast<osg::View*>(visitor.getActionAdapter());
    return view ? view->getCamera() : nullptr;
}

osg::Matrixd worldTo(const osg::Node& node)
{
    const osg::NodePathList paths = node.getParentalNodePaths();
    return paths.empty() ? osg::Matrixd() : osg::computeWorldToLocal(paths.front());
}

/// Of what the key points are attached to.
osg::Matrixd worldToKeys(const MixedScene& scene)
{
    const osg::ref_ptr<const osg::Node> keys = scene.getKeyNode();
    return worldTo(keys ? *keys : scene);
}

osg::Matrixd keysToScreen(const MixedScene& scene, const osg::Camera& camera)
{
    return osg::Matrixd::inverse(worldToKeys(scene)) * camera.getViewMatrix() *
           camera.getProjectionMatrix();
}

/// The point whose marker is under the mouse, the nearest one to the eye of several.
std::optional<std::size_t> markerUnder(const MixedScene& scene, const Event& event,
                                       const osg::Camera& camera)
{
    if (scene.getMarks() == MixMarks::Off || !camera.getViewport())
        return {};
    const osg::Matrixd toScreen = keysToScreen(scene, camera);
    const double width = camera.getViewport()->width(), height = camera.getViewport()->height();
    const std::vector<osg::Vec3d> points = scene.getKeyPoints();
    std::optional<std::size_t> found;
    double nearest = 1.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const osg::Vec4d clip = osg::Vec4d(points[i], 1.0) * toScreen;
        const osg::Vec3d at(clip.x() / clip.w(), clip.y() / clip.w(), clip.z() / clip.w());
        const double x = 0.5 * width * (at.x() - event.getXnormalized());
        const double y = 0.5 * height * (at.y() - event.getYnormalized());
        if (clip.w() > 0.0 && at.z() >= -1.0 && at.z() < nearest && std::hypot(x, y) <= GrabPixels)
        {
            found = i;
            nearest = at.z();
        }
    }
    return found;
}

} // namespace

std::optional<osg::Vec3d> placeUnder(MixedScene& scene, const Event& event,
                                     osgGA::EventVisitor& visitor)
{
    auto* camera = const_cast<osg::Camera*>(cameraOf(visitor));
    if (!camera)
        return {};
    osg::ref_ptr<osgUtil::LineSegmentIntersector> ray = new osgUtil::LineSegmentIntersector(
        osgUtil::Intersector::PROJECTION, event.getXnormalized(), event.getYnormalized());
    osgUtil::IntersectionVisitor intersect(ray);
    camera->accept(intersect);
    for (const auto& hit : ray->getIntersections())
        if (std::find(hit.nodePath.begin(), hit.nodePath.end(), &scene) != hit.nodePath.end())
            return hit.getWorldIntersectPoint() * worldToKeys(scene);
    return {};
}

void addPoint(MixedScene& scene, const osg::Vec3d& place)
{
    std::vector<osg::Vec3d> points = scene.getKeyPoints();
    points.push_back(place);
    scene.setKeyPoints(points, scene.getKeyMode());
}

bool MixDrag::press(MixedScene& scene, const Event& event, osgGA::EventVisitor& visitor)
{
    const osg::Camera* camera = cameraOf(visitor);
    const bool takes = event.getModKeyMask() & Event::MODKEY_CTRL;
    const bool changes = event.getModKeyMask() & Event::MODKEY_SHIFT;
    if (!camera || event.getButton() != Event::LEFT_MOUSE_BUTTON || takes == changes)
        return false;
    std::vector<osg::Vec3d> points = scene.getKeyPoints();
    const std::optional<std::size_t> marker = markerUnder(scene, event, *camera);
    if (takes && marker)
        _held = Held{*marker, points[*marker] * keysToScreen(scene, *camera),
                     event.getXnormalized(), event.getYnormalized()};
    else if (changes && marker)
    {
        points.erase(points.begin() + std::ptrdiff_t(*marker));
        scene.setKeyPoints(points, scene.getKeyMode());
    }
    else if (const auto place = changes ? placeUnder(scene, event, visitor) : std::nullopt)
        addPoint(scene, *place);
    else
        return false;
    _swallows = true;
    return true;
}

bool MixDrag::answer(MixedScene& scene, const Event& event, osgGA::EventVisitor& visitor)
{
    switch (event.getEventType())
    {
    case Event::PUSH:
        return press(scene, event, visitor);
    case Event::DRAG:
    {
        std::vector<osg::Vec3d> points = scene.getKeyPoints();
        const osg::Camera* camera = cameraOf(visitor);
        if (_held && camera && _held->point < points.size())
        {
            const osg::Vec3d offset(event.getXnormalized() - _held->x,
                                    event.getYnormalized() - _held->y, 0.0);
            points[_held->point] =
                (_held->place + offset) * osg::Matrixd::inverse(keysToScreen(scene, *camera));
            scene.setKeyPoints(points, scene.getKeyMode());
        }
        return _swallows;
    }
    case Event::RELEASE:
        _held.reset();
        return std::exchange(_swallows, false);
    default:
        return false;
    }
}

} // namespace osgMultiRender
