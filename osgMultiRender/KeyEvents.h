// SPDX-License-Identifier: MIT
// Keys of a kit in osgviewer. Not installed.
#pragma once

#include <osg/ApplicationUsage>
#include <osgGA/EventVisitor>

#include <string>
#include <vector>

namespace osgMultiRender
{

/// Lists keys in the usage of osgviewer. A key has `key`, a char, and `help`.
template <class Key> bool addToUsage(const std::vector<Key>& keys)
{
    for (const Key& key : keys)
        osg::ApplicationUsage::instance()->addKeyboardMouseBinding(std::string(1, key.key),
                                                                   key.help);
    return true;
}

/// Calls `answer` with each key of `keys` that has been pressed and that nobody else has answered,
/// and with its event; then it is answered, and the view is drawn again.
template <class Key, class Answer>
void answerPressed(osgGA::EventVisitor& visitor, const std::vector<Key>& keys, const Answer& answer)
{
    for (const osg::ref_ptr<osgGA::Event>& each : visitor.getEvents())
    {
        osgGA::GUIEventAdapter* event = each->asGUIEventAdapter();
        if (!event || event->getHandled() ||
            event->getEventType() != osgGA::GUIEventAdapter::KEYDOWN)
            continue;
        for (const Key& key : keys)
            if (event->getKey() == key.key)
            {
                answer(key.key, *event);
                event->setHandled(true);
                if (osgGA::GUIActionAdapter* viewer = visitor.getActionAdapter())
                    viewer->requestRedraw();
            }
    }
}

} // namespace osgMultiRender
