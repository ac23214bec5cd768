// SPDX-License-Identifier: MIT
#pragma once

#include "FloorPictures.h"

#include <osg/MatrixTransform>

#include <string>

/// Pictures of shadow volumes of boxes on the floor of floorScene.
namespace volumeScene
{

/// All lights shine on it, by shadow volumes; shadows are black.
osg::ref_ptr<osgShadowVolume::ShadowedScene> shadowed();

/// A cube of the given side.
osg::ref_ptr<osg::Geode> box(const osg::Vec3& center, float side);

osg::ref_ptr<osg::MatrixTransform> moved(const osg::Vec3& place, osg::ref_ptr<osg::Node> node);

/// Looks down at the floor from the front.
support::CameraSpec fromFront();

/// The floor and two cubes under a point light (number 0) and a directional one (1); seen
/// fromFront() both throw shadows.
osg::ref_ptr<osgShadowVolume::ShadowedScene> twoBoxes();

/// As twoBoxes(), of a group that is there already.
void addTwoBoxes(osg::Group& group);

/// Takes away the bounds of all drawables below. Nothing is known of what they may touch then, so
/// everything has to be drawn: each caster for each light, by z-fail.
void forgetBounds(osg::Node& node);

/// The plan of the last frame; a failure where there is none.
osgMultiRender::Plan planOf(const osgShadowVolume::ShadowedScene& scene);

/// As floorScene::entryOf(), of the last plan.
std::string entryOf(const osgShadowVolume::ShadowedScene& scene, const std::string& subject);

/// A count of the last plan; NaN where it has none of that name.
double countOf(const osgShadowVolume::ShadowedScene& scene, const std::string& name);

/// Share of the pixels with a red of less than 20.
double darkShare(const osg::Image& image);

/// Both pictures are the same to the last bit; otherwise they are written as `name`.
testing::AssertionResult areEqual(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name);

/// The picture of the process's viewer, from the lower left corner.
osg::ref_ptr<osg::Image> render(osg::Node& scene, const support::CameraSpec& camera,
                                int width = floorScene::Width, int height = floorScene::Height,
                                unsigned int frames = 2);

/// Writes the picture where OSGKITS_KEEP_IMAGES is set.
void keep(const osg::Image* image, const std::string& name);

} // namespace volumeScene
