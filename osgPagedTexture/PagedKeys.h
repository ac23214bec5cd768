// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <vector>

namespace osgGA
{
class EventVisitor;
} // namespace osgGA

namespace osgPagedTexture
{

class PagedScene;

/// A key of the viewer that PagedScenes answer to. None of osgviewer's own, nor of the other kits.
struct PagedKey
{
    char key;         ///< As GUIEventAdapter::getKey() gives it: capitals are with shift.
    const char* help; ///< What it does.
};

/// All of them. Loading the library enters them in osg::ApplicationUsage, so that osgviewer's help
/// (key h) has them.
OSGPAGEDTEXTURE_EXPORT const std::vector<PagedKey>& pagedKeys();

/// Answers to the key events of an event traversal.
void answerKeys(PagedScene& scene, osgGA::EventVisitor& visitor);

} // namespace osgPagedTexture
