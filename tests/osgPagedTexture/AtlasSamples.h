// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/ModelPhotos.h>

#include <osg/Geometry>
#include <osg/Image>
#include <osg/Texture>

#include <string>

/// The layout of all photographs of a model, whose paths are relative to `folder`. `tight`: only of
/// what it shows of them, in pieces.
osgPagedTexture::AtlasLayout layoutOf(const osgPagedTexture::ModelPhotos& model,
                                      const std::string& folder, bool tight = false);

/// The whole atlas, painted pixel by pixel, row 0 at the bottom: padding repeats edges.
osg::ref_ptr<osg::Image> paintAtlas(const osgPagedTexture::AtlasLayout& layout,
                                    const std::string& folder);

/// A square of one texture, which has the photograph as its file name. The coordinates are those of
/// its corners: left bottom, right bottom, right top, left top; which diagonal splits the square is
/// the driver's choice, so for pictures they make a parallelogram.
osg::ref_ptr<osg::Geometry> texturedSquare(const std::string& photograph,
                                           osg::Texture::WrapMode wrap,
                                           const osg::Vec2 (&corners)[4]);

/// All textures are looked up without filtering, so that a picture does not depend on neighbours.
void lookUpNearest(osg::Node& node);
