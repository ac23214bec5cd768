// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixKeys.h>

#include <osgMultiRender/MixDrag.h>
#include <osgMultiRender/MixedScene.h>

#include <osg/ApplicationUsage>
#include <osg/ValueObject>
#include <osgGA/EventVisitor>

#include <algorithm>
#include <optional>
#include <sstream>
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

/// What the first scene that meets a key makes of its setting; the others take that.
constexpr char AnswerName[] = "osgMultiRender.answer";
/// Of an event that a scene has handled: whether it is for all scenes.
constexpr char SharedName[] = "osgMultiRender.shared";

/// The next one of three, or what another scene has chosen.
int chooseNext(int value, KeyEvent& event)
{
    int chosen = (value + 1) % 3;
    if (!event.getUserValue(AnswerName, chosen))
        event.setUserValue(AnswerName, chosen);
    return chosen;
}

/// False for a key that has nothing to do with this scene.
bool answer(char key, MixedScene& scene, KeyEvent& event, osgGA::EventVisitor& visitor)
{
    switch (key)
    {
    case 'K':
        scene.setMarks(MixMarks(chooseNext(int(scene.getMarks()), event)));
        break;
    case 'J':
        scene.setKeyPoints(scene.getKeyPoints(),
                           KeyMode(chooseNext(int(scene.getKeyMode()), event)));
        break;
    case '[':
        scaleRanges(scene, 1.0 / 1.1);
        break;
    case ']':
        scaleRanges(scene, 1.1);
        break;
    case 'R':
        scene.readFilesAgain();
        break;
    default:
        const std::optional<osg::Vec3d> place = placeUnder(scene, event, visitor);
        if (place && key == 'Y')
            addPoint(scene, *place);
        else if (place)
            changeNearest(scene, *place, key == 'X');
        return place.has_value(); // another scene may lie there
    }
    return true;
}

/// Keys of a place are one scene's, the others all scenes'.
bool isOfPlace(int key)
{
    return key == 'Y' || key == 'Q' || key == 'X';
}

/// Whether this scene answers; one in several places is asked more than once.
bool answerKey(MixedScene& scene, KeyEvent& event, osgGA::EventVisitor& visitor)
{
    const auto& keys = mixKeys();
    const auto key = std::find_if(keys.begin(), keys.end(),
                                  [&](const MixKey& each) { return event.getKey() == each.key; });
    if (key == keys.end())
        return false;
    std::ostringstream name;
    name << AnswerName << &scene;
    bool isAnswered = false;
    if (event.getUserValue(name.str(), isAnswered) || !answer(key->key, scene, event, visitor))
        return false;
    event.setUserValue(name.str(), true);
    event.setUserValue(SharedName, !isOfPlace(key->key));
    return true;
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

void answerKeys(MixedScene& scene, osgGA::EventVisitor& visitor, MixDrag& drag)
{
    for (const osg::ref_ptr<osgGA::Event>& each : visitor.getEvents())
    {
        KeyEvent* event = each->asGUIEventAdapter();
        if (!event)
            continue;
        const bool isKey = event->getEventType() == KeyEvent::KEYDOWN;
        bool isShared = false;
        if (event->getHandled() && !(event->getUserValue(SharedName, isShared) && isShared))
            continue;
        if (!(isKey ? answerKey(scene, *event, visitor) : drag.answer(scene, *event, visitor)))
            continue;
        event->setHandled(true);
        if (osgGA::GUIActionAdapter* viewer = visitor.getActionAdapter())
            viewer->requestRedraw();
    }
}

} // namespace osgMultiRender
