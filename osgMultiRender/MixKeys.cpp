// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixKeys.h>

#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixedScene.h>

#include <osg/ApplicationUsage>
#include <osg/Transform>
#include <osg/View>
#include <osgGA/EventVisitor>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include <algorithm>
#include <optional>
#include <string>

namespace osgMultiRender
{

namespace
{

using KeyEvent = osgGA::GUIEventAdapter;

[[maybe_unused]] const bool isInUsage = []
{
    for (const MixKey& key : mixKeys())
        osg::ApplicationUsage::instance()->addKeyboardMouseBinding(std::string(1, key.key),
                                                                   key.help);
    return true;
}();

osg::Matrixd worldTo(const osg::Node& node)
{
    const osg::NodePathList paths = node.getParentalNodePaths();
    return paths.empty() ? osg::Matrixd() : osg::computeWorldToLocal(paths.front());
}

/// The surface of the scene under the mouse, in the coordinates of the key points.
std::optional<osg::Vec3d> placeUnder(MixedScene& scene, const KeyEvent& event,
                                     osgGA::EventVisitor& visitor)
{
    auto* view = dynamic_cast<osg::View*>(visitor.getActionAdapter());
    if (!view || !view->getCamera())
        return {};
    osg::ref_ptr<osgUtil::LineSegmentIntersector> ray = new osgUtil::LineSegmentIntersector(
        osgUtil::Intersector::PROJECTION, event.getXnormalized(), event.getYnormalized());
    osgUtil::IntersectionVisitor intersect(ray);
    view->getCamera()->accept(intersect);
    for (const auto& hit : ray->getIntersections())
        if (std::find(hit.nodePath.begin(), hit.nodePath.end(), &scene) != hit.nodePath.end())
        {
            const osg::ref_ptr<const osg::Node> keys = scene.getKeyNode();
            return hit.getWorldIntersectPoint() * worldTo(keys ? *keys : scene);
        }
    return {};
}

void scaleRanges(MixedScene& scene, double factor)
{
    for (const unsigned int number : scene.getRenderings())
    {
        MixRange range = scene.getRange(number);
        for (double* dr : {&range.dr0, &range.dr1, &range.dr2, &range.dr3})
            *dr *= factor;
        scene.setRange(number, range);
    }
}

void addPoint(MixedScene& scene, const osg::Vec3d& place)
{
    std::vector<osg::Vec3d> points = scene.getKeyPoints();
    points.push_back(place);
    scene.setKeyPoints(points, scene.getKeyMode());
}

/// The one that is nearest to a place: moves there, or goes.
void changeNearest(MixedScene& scene, const osg::Vec3d& place, bool removes)
{
    std::vector<osg::Vec3d> points = scene.getKeyPoints();
    const auto nearest = std::min_element(points.begin(), points.end(),
                                          [&](const auto& a, const auto& b) {
                                              return (a - place).length2() < (b - place).length2();
                                          });
    if (nearest == points.end())
        return;
    if (removes)
        points.erase(nearest);
    else
        *nearest = place;
    scene.setKeyPoints(points, scene.getKeyMode());
}

/// The looks before stay until the new ones are linked.
void reimport(MixedScene& scene)
{
    for (const unsigned int number : scene.getRenderings())
        if (const std::string file = scene.getRendering(number)->fileName; !file.empty())
            scene.setRendering(number, importRendering(file));
}

void answer(char key, MixedScene& scene, const KeyEvent& event, osgGA::EventVisitor& visitor)
{
    switch (key)
    {
    case 'K':
        scene.setMarks(MixMarks((int(scene.getMarks()) + 1) % 3));
        break;
    case 'J':
        scene.setKeyPoints(scene.getKeyPoints(), KeyMode((int(scene.getKeyMode()) + 1) % 3));
        break;
    case '[':
        scaleRanges(scene, 1.0 / 1.1);
        break;
    case ']':
        scaleRanges(scene, 1.1);
        break;
    case 'R':
        reimport(scene);
        break;
    default:
        if (const std::optional<osg::Vec3d> place = placeUnder(scene, event, visitor))
        {
            if (key == 'Y')
                addPoint(scene, *place);
            else
                changeNearest(scene, *place, key == 'X');
        }
    }
}

} // namespace

const std::vector<MixKey>& mixKeys()
{
    static const std::vector<MixKey> keys = {
        {'K', "Key points: not shown, shown, with what joins them"},
        {'J', "Key points: single, joined, joined to a loop"},
        {'Y', "A new key point on the surface under the mouse"},
        {'Q', "The nearest key point goes to the surface under the mouse"},
        {'X', "Takes away the key point nearest to the surface under the mouse"},
        {'R', "Reads the files of renderings again"},
        {'[', "Ranges of all renderings shorter by a tenth"},
        {']', "Ranges of all renderings longer by a tenth"},
    };
    return keys;
}

void answerKeys(MixedScene& scene, osgGA::EventVisitor& visitor)
{
    for (const osg::ref_ptr<osgGA::Event>& each : visitor.getEvents())
    {
        KeyEvent* event = each->asGUIEventAdapter();
        if (!event || event->getHandled() || event->getEventType() != KeyEvent::KEYDOWN)
            continue;
        for (const MixKey& key : mixKeys())
            if (event->getKey() == key.key)
            {
                answer(key.key, scene, *event, visitor);
                event->setHandled(true);
                if (osgGA::GUIActionAdapter* viewer = visitor.getActionAdapter())
                    viewer->requestRedraw();
            }
    }
}

} // namespace osgMultiRender
