// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <string>
#include <vector>

namespace osgGA
{
class EventVisitor;
} // namespace osgGA

namespace osgShadowVolume
{

class ShadowedScene;

/// A key of the viewer that ShadowedScenes answer to. None of osgviewer's own.
struct ShadowKey
{
    char key;            ///< As GUIEventAdapter::getKey() gives it: capitals are with shift.
    const char* help;    ///< What it does.
    const char* setting; ///< The SceneOption that it changes; null for the plan's key.
    /// What the setting becomes, one after the other; none where the scene's lights decide.
    std::vector<std::string> values;
};

/// All of them. Loading the library enters them in osg::ApplicationUsage, so that osgviewer's help
/// (key h) has them.
OSGSHADOWVOLUME_EXPORT const std::vector<ShadowKey>& shadowKeys();

/// Answers to the key events of an event traversal: changes settings of `scene` and prints what is
/// on now, one line a key, at NOTICE. Where a traversal meets several scenes the first one decides
/// and prints, and the others follow. The first traversal of a view with a window that a user sees
/// prints the list of keys, once a process.
void answerKeys(ShadowedScene& scene, osgGA::EventVisitor& visitor);

} // namespace osgShadowVolume
