// SPDX-License-Identifier: MIT
#pragma once

#include "LabelPictures.h"

#include <osgLabels/MapLabels.h>

#include <osg/Image>

/// Pictures of map labels over simple scenes.
namespace mapScene
{

using labelScene::box;
using labelScene::countOf;
using labelScene::keep;
using labelScene::Picture;
using labelScene::render;

/// The fixture of tests that draw map labels, which remember what was before: each begins at time
/// 0. Warnings that no test takes are failures.
class MapTest : public labelScene::PictureTest
{
protected:
    void TearDown() override;
};

/// A label with an opaque plate of pure red and no letters to be seen, so that its pixels are
/// known.
extern const char* const RedPlate;

/// One node with one label.
osg::ref_ptr<osgLabels::MapLabels> label(const std::string& text, const osg::Vec3d& anchor,
                                         const std::string& feature = std::string(),
                                         double priority = 0.0);

/// A LabelScene over the nodes with these settings, beside those of RedPlate.
osg::ref_ptr<osgLabels::LabelScene> scene(const std::vector<osg::ref_ptr<osg::Node>>& nodes,
                                          const std::string& settings = std::string());

/// Pixels that show a red plate.
int redPixels(const osg::Image& picture);
/// In the columns from `first` to before `last`.
int redPixels(const osg::Image& picture, int first, int last);

/// The pixel where a point of the scene is drawn by fromFront().
osg::Vec2d pixelOf(const osg::Vec3d& point,
                   const support::CameraSpec& camera = labelScene::fromFront());

/// A parallelogram in a Geode of that name: open.
osg::ref_ptr<osg::Geode> sheet(const std::string& name, const osg::Vec3& corner,
                               const osg::Vec3& width, const osg::Vec3& height,
                               const osg::Vec4& color = osg::Vec4(0.6f, 0.7f, 0.6f, 1.0f));

} // namespace mapScene
