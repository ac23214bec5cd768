// SPDX-License-Identifier: MIT
// Textures of renderings. Not installed.
#pragma once

#include <osgMultiRender/Rendering.h>

#include <osg/Texture>

namespace osgMultiRender
{

/// The texture with its image files, from OSG's object cache where it has them. One that can't be
/// read is white, with a warning.
osg::ref_ptr<osg::Texture> readTexture(const RenderingTexture& texture);

/// One white texel: what a rendering reads where the model has no texture.
osg::ref_ptr<osg::Texture> whiteTexture();

} // namespace osgMultiRender
