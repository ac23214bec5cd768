// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

#include <memory>

namespace osgPagedTexture
{

class Pager;

/// Has what the PagedLOD and ProxyNode objects of a subgraph read later, in whatever thread, give
/// its textures to the pager, too, and so on below that. Their options get a read callback, which
/// hands on to the one that was there.
void pageLater(osg::Node& node, const std::shared_ptr<Pager>& pager);

} // namespace osgPagedTexture
