// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <vector>

namespace osgGA
{
class EventVisitor;
} // namespace osgGA

namespace osgLabels
{

class LabelScene;

/// A key of the viewer that LabelScenes answer to. None of osgviewer's own.
struct LabelKey
{
    char key;         ///< As GUIEventAdapter::getKey() gives it: capitals are with shift.
    const char* help; ///< What it does.
};

/// All of them. Loading the library enters them in osg::ApplicationUsage, so that osgviewer's help
/// (key h) has them.
OSGLABELS_EXPORT const std::vector<LabelKey>& labelKeys();

/// Answers to the key events of an event traversal, and prints what the last one has asked for as
/// soon as it is drawn, one line at NOTICE.
void answerKeys(LabelScene& scene, osgGA::EventVisitor& visitor);

} // namespace osgLabels
