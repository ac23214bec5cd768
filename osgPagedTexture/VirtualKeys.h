// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PagedKeys.h>

namespace osgGA
{
class EventVisitor;
} // namespace osgGA

namespace osgPagedTexture
{

class VirtualScene;

/// Those that a VirtualScene answers to.
OSGPAGEDTEXTURE_EXPORT const std::vector<PagedKey>& virtualKeys();

/// Answers to the key presses of a frame that nobody has handled.
void answerKeys(VirtualScene& scene, osgGA::EventVisitor& visitor);

} // namespace osgPagedTexture
