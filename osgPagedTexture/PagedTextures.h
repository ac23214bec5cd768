// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pager.h>

#include <osg/Node>

#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

class FileImages;

/// A texture that is not paged, and why.
struct LeftTexture
{
    std::string name;
    std::string reason;
};

/// Hands the 2D textures of a subgraph to a pager. Their osg::Texture2D stay where they are with
/// all their parameters; only their images go. `images` has read the subgraph, or is null for one
/// that was read as ever: then files that the images were read from are read anew.
std::vector<LeftTexture> pageTextures(osg::Node& node, const std::shared_ptr<Pager>& pager,
                                      const FileImages* images);

} // namespace osgPagedTexture
