// SPDX-License-Identifier: MIT
#include <osgLabels/LabelKeys.h>

#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>

#include <osgMultiRender/KeyEvents.h>

#include <osg/Notify>
#include <osg/View>
#include <osgGA/EventVisitor>

#include <string>

namespace osgLabels
{

namespace
{

using KeyEvent = osgGA::GUIEventAdapter;

[[maybe_unused]] const bool isInUsage = osgMultiRender::addToUsage(labelKeys());

void printPicked(LabelScene& scene)
{
    const std::optional<LabelScene::Picked> picked = scene.takePicked(PickAsker::Keys);
    if (!picked)
        return;
    const std::string line = picked->identifier ? std::to_string(picked->identifier) + " '" +
                                                      picked->text + "' " + picked->path
                                                : "nothing labelled is there";
    OSG_NOTICE << "osgLabels: " << line << std::endl;
}

/// The camera that shows what the mouse is over; null where several do.
const osg::Camera* cameraOf(osgGA::EventVisitor& visitor)
{
    const auto* view = dynamic_cast<const osg::View*>(visitor.getActionAdapter());
    return view && view->getNumSlaves() == 0 ? view->getCamera() : nullptr;
}

template <class Value> Value next(Value value, Value last)
{
    return value == last ? Value(0) : Value(int(value) + 1);
}

/// Of map labels; prints what is on now.
void change(char key, LabelScene& scene)
{
    LabelSettings settings = scene.getSettings();
    std::string name;
    if (key == 'U')
    {
        settings.mapTest = next(settings.mapTest, MapTest::Share);
        name = "maptest";
    }
    else if (key == 'O')
    {
        settings.mapAction = next(settings.mapAction, MapAction::Ignore);
        name = "mapaction";
    }
    else
    {
        settings.declutter = !settings.declutter;
        name = "declutter";
    }
    scene.setSettings(settings);
    for (const LabelOption& option : labelOptions())
        if (option.name == name)
            OSG_NOTICE << "osgLabels: " << name << "=" << option.format(settings) << std::endl;
}

void answer(char key, LabelScene& scene, const KeyEvent& event, osgGA::EventVisitor& visitor)
{
    if (key == 'I')
        scene.pick(event.getXnormalized(), event.getYnormalized(), cameraOf(visitor),
                   PickAsker::Keys);
    else if (key == 'L')
        scene.setShown(!scene.isShown());
    else
        change(key, scene);
}

} // namespace

const std::vector<LabelKey>& labelKeys()
{
    static const std::vector<LabelKey> keys = {
        {'I', "Prints identifier, text and nodes of the object under the mouse"},
        {'L', "Labels, shown or not"},
        {'O', "Map labels behind something: hidden, outlined, grey, faded, shown"},
        {'U', "Map labels are hidden by pixels, by anchors, by visible shares"},
        {'G', "Map labels make way for more important ones, or not"},
    };
    return keys;
}

void answerKeys(LabelScene& scene, osgGA::EventVisitor& visitor)
{
    printPicked(scene);
    osgMultiRender::answerPressed(visitor, labelKeys(),
                                  [&](char key, const KeyEvent& event)
                                  { answer(key, scene, event, visitor); });
}

} // namespace osgLabels
