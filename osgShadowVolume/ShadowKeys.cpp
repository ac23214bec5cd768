// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowKeys.h>

#include <osgShadowVolume/SceneOptions.h>

#include <osg/ApplicationUsage>
#include <osg/LightSource>
#include <osg/Notify>
#include <osg/ValueObject>
#include <osgGA/EventVisitor>
#include <osgViewer/View>

#include <algorithm>
#include <map>
#include <sstream>

namespace osgShadowVolume
{

namespace
{

using KeyEvent = osgGA::GUIEventAdapter;

/// What the first scene that an event met has made of its setting.
constexpr char AnswerName[] = "osgShadowVolume.answer";

/// By number; the name of the last light of a number.
using Lights = std::map<int, std::string>;

class LightCollector : public osg::NodeVisitor
{
public:
    LightCollector() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}

    void apply(osg::LightSource& source) override
    {
        if (const osg::Light* light = source.getLight())
            lights[light->getLightNum()] =
                light->getName().empty() ? source.getName() : light->getName();
        traverse(source);
    }

    Lights lights;
};

/// The lights of the view, its headlight too.
Lights lightsOf(osgGA::EventVisitor& visitor)
{
    LightCollector collector;
    if (const auto* view = dynamic_cast<const osg::View*>(visitor.getActionAdapter());
        view && view->getLight() && view->getLightingMode() != osg::View::NO_LIGHT)
        collector.lights[view->getLight()->getLightNum()] = "of the viewer";
    visitor.getNodePath().front()->accept(collector);
    return collector.lights;
}

/// The value after the present one; the first where the present one is none of them.
std::string nextOf(const std::vector<std::string>& values, const std::string& present)
{
    const auto found = std::find(values.begin(), values.end(), present);
    return found == values.end() || found + 1 == values.end() ? values.front() : *(found + 1);
}

/// From all lights to the first one and so on, back to all after the last.
std::string nextLight(const Lights& lights, const std::string& present, bool forward)
{
    std::vector<std::string> values = {"all"};
    for (const auto& light : lights)
        values.push_back(std::to_string(light.first));
    if (!forward)
        std::reverse(values.begin(), values.end());
    return nextOf(values, present);
}

std::string nextValue(const ShadowKey& key, const std::string& present,
                      osgGA::EventVisitor& visitor)
{
    if (!key.values.empty())
        return nextOf(key.values, present);
    return nextLight(lightsOf(visitor), present, key.key == 'N');
}

/// What is printed behind "light=3".
std::string describeLight(const std::string& value, osgGA::EventVisitor& visitor)
{
    const Lights lights = lightsOf(visitor);
    std::string text = ", of " + std::to_string(lights.size());
    for (const auto& [number, name] : lights)
        if (value == std::to_string(number) && !name.empty())
            text = " (" + name + ")" + text;
    return text;
}

void printPlans(const ShadowedScene& scene)
{
    std::ostringstream text;
    for (const osgMultiRender::Plan& plan : scene.getPlans())
        text << toString(plan);
    OSG_NOTICE << (text.str().empty() ? "osgShadowVolume: no frame has been drawn, so no plan\n"
                                      : text.str())
               << std::flush;
}

void answer(const ShadowKey& key, ShadowedScene& scene, KeyEvent& event,
            osgGA::EventVisitor& visitor)
{
    if (!key.setting)
    {
        printPlans(scene);
        event.setUserValue(AnswerName, std::string("plan"));
        event.setHandled(true);
        return;
    }
    const SceneOption& option = *findSceneOption(key.setting);
    std::string value;
    const bool follows = event.getUserValue(AnswerName, value);
    if (!follows)
        value = nextValue(key, option.format(scene), visitor);
    option.parse(scene, value);
    if (follows)
        return;
    event.setUserValue(AnswerName, value);
    event.setHandled(true);
    OSG_NOTICE << "osgShadowVolume: " << option.name << "=" << value
               << (option.name == "light" ? describeLight(value, visitor) : std::string())
               << std::endl;
    if (osgGA::GUIActionAdapter* viewer = visitor.getActionAdapter())
        viewer->requestRedraw();
}

/// Headless windows get their events from programs.
bool hasUser(osgViewer::View& view)
{
    std::vector<osgViewer::GraphicsWindow*> windows;
    if (view.getViewerBase())
        view.getViewerBase()->getWindows(windows);
    return std::any_of(windows.begin(), windows.end(),
                       [](const osgViewer::GraphicsWindow* window)
                       { return window->getCompoundClassName() != "osgHeadless::Window"; });
}

void listKeysOnce(osgGA::EventVisitor& visitor)
{
    static bool done = false;
    auto* view = done ? nullptr : dynamic_cast<osgViewer::View*>(visitor.getActionAdapter());
    if (!view || !hasUser(*view))
        return;
    done = true;
    std::ostringstream text;
    text << "osgShadowVolume: keys for shadows, with shift\n";
    for (const ShadowKey& key : shadowKeys())
        text << "  " << key.key << "  " << key.help << "\n";
    OSG_NOTICE << text.str() << std::flush;
}

/// Enters the keys in what osgviewer shows as its help, when the library is loaded.
[[maybe_unused]] const bool isInUsage = []
{
    for (const ShadowKey& key : shadowKeys())
        osg::ApplicationUsage::instance()->addKeyboardMouseBinding(std::string(1, key.key),
                                                                   key.help);
    return true;
}();

} // namespace

const std::vector<ShadowKey>& shadowKeys()
{
    static const std::vector<ShadowKey> keys = {
        {'D', "Shadows: volumes, maps, none", "shadows", {"volumes", "map", "off"}},
        {'T',
         "Who finds the silhouettes: the fastest, tessellation, geometry shader, CPU",
         "technique",
         {"auto", "tess", "geometry", "cpu"}},
        {'V', "Shadow volumes, shown or not", "show", {"volumes", "picture"}},
        {'M', "Mask of where light reaches, shown or not", "show", {"mask", "picture"}},
        {'N', "Next light alone; all after the last one", "light", {}},
        {'B', "Light before alone; all before the first one", "light", {}},
        {'A', "All lights", "light", {"all"}},
        {'E', "Shadows of the headlight, on or off", "headlight", {"shadow", "noshadow"}},
        {'P', "Prints what was drawn for each light, and why", nullptr, {}},
    };
    return keys;
}

void answerKeys(ShadowedScene& scene, osgGA::EventVisitor& visitor)
{
    listKeysOnce(visitor);
    for (const osg::ref_ptr<osgGA::Event>& each : visitor.getEvents())
    {
        KeyEvent* event = each->asGUIEventAdapter();
        if (!event || event->getEventType() != KeyEvent::KEYDOWN)
            continue;
        std::string first;
        if (event->getHandled() && !event->getUserValue(AnswerName, first))
            continue;
        for (const ShadowKey& key : shadowKeys())
            if (event->getKey() == key.key)
                answer(key, scene, *event, visitor);
    }
}

} // namespace osgShadowVolume
