// SPDX-License-Identifier: MIT
// Tile stores of known pictures, and scenes that show them as virtual and as plain textures.
#pragma once

#include "PagedScenes.h"

#include <osgPagedTexture/Pixels.h>
#include <osgPagedTexture/TilePack.h>
#include <osgPagedTexture/VirtualScene.h>
#include <osgPagedTexture/VirtualTexture.h>

#include <functional>

namespace virtuals
{

/// All levels of a picture, of RGB or RGBA, level 0 first; sides are halved and rounded up.
using Levels = std::vector<osgPagedTexture::Pixels>;

/// A picture that differs in each texel.
Levels makeLevels(int width, int height, unsigned int seed = 1, int channels = 3);
/// The same colour everywhere, on all levels.
Levels makePlain(int width, int height, osgPagedTexture::TileColor color);
/// Another picture over a part of it, from the bottom left corner.
Levels makeLevels(const osgPagedTexture::Pixels& picture);

/// A packed store of them, its tiles as PNG. `tileSide` with a border of `border` on both sides.
void buildStore(const std::string& path, const Levels& levels, int tileSide = 64, int border = 2);
/// Puts all tiles of an open store anew and commits.
void writeTiles(osgPagedTexture::TileWriter& writer, const osgPagedTexture::TileGrid& grid,
                const Levels& levels,
                const std::function<bool(const osgPagedTexture::TileKey&)>& which = {});
std::string encodePng(const osgPagedTexture::Pixels& pixels);

/// What GL makes of the same levels.
osg::ref_ptr<osg::Texture2D> makePlainTexture(const Levels& levels);
osg::ref_ptr<osgPagedTexture::VirtualTexture> makeVirtualTexture(const std::string& store);

/// A scene over a model, installed. Pages are not compressed and fade at once unless said.
osg::ref_ptr<osgPagedTexture::VirtualScene>
makeScene(osg::Node* model, const std::string& settings = "", bool waits = true);

/// A square of `side` units in the plane z = 0, its centre in the origin, with a texture.
osg::ref_ptr<osg::Geode> makeFloor(osg::Texture2D* texture, float side, float repeat = 1.0f);

/// Draws frames until the scene is at rest, and one more; a failure after a minute.
osg::ref_ptr<osg::Image> settle(support::HeadlessViewer& viewer,
                                osgPagedTexture::VirtualScene& scene, osg::Node* root,
                                const support::CameraSpec& camera, int width = 320,
                                int height = 240);

/// A count of the scene's first plan.
double countOf(const osgPagedTexture::VirtualScene& scene, const std::string& name);

/// Makes llvmpipe filter as the specification says, not as it is quickest. Before the first
/// context.
void filterExactly();

} // namespace virtuals
