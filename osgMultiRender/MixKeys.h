// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <vector>

namespace osgGA
{
class EventVisitor;
} // namespace osgGA

namespace osgMultiRender
{

class MixDrag;
class MixedScene;

/// A key of the viewer that MixedScenes answer to. None of osgviewer's own.
struct MixKey
{
    char key;         ///< As GUIEventAdapter::getKey() gives it: capitals are with shift.
    const char* help; ///< What it does.
};

/// All of them. Loading the library enters them in osg::ApplicationUsage, so that osgviewer's help
/// (key h) has them.
OSGMULTIRENDER_EXPORT const std::vector<MixKey>& mixKeys();

/// Answers to the keys and the mouse of an event traversal.
void answerKeys(MixedScene& scene, osgGA::EventVisitor& visitor, MixDrag& drag);

} // namespace osgMultiRender
