// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/ShadowedScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/Geode>
#include <osg/LightSource>
#include <osg/MatrixTransform>

#include <string>

/// Pictures of a room of boxes before a leaning wall that may be a mirror.
namespace mirrorScene
{

constexpr int Width = 320, Height = 240;

/// Of this process, without a light of its own.
support::HeadlessViewer& viewer();

support::CameraSpec camera(const osg::Vec3d& eye = {1.0, -9.0, 4.0},
                           const osg::Vec3d& center = {0.0, 1.0, 1.0});

osg::ref_ptr<osg::Image> picture(osg::Node& scene, const support::CameraSpec& from = camera());

/// Nothing shines but what a test's materials and lights say.
osg::ref_ptr<osgShadowVolume::ShadowedScene> emptyScene();

void setColor(osg::Node& node, const osg::Vec4& color, const osg::Vec4& emission = {0, 0, 0, 1});

osg::ref_ptr<osg::Geode> box(const osg::Vec3& center, const osg::Vec3& size,
                             const osg::Vec4& color);

osg::ref_ptr<osg::Geode> quad(const osg::Vec3& corner, const osg::Vec3& u, const osg::Vec3& v,
                              const osg::Vec4& color);

osg::ref_ptr<osg::LightSource> light(unsigned int number, const osg::Vec4& position,
                                     const osg::Vec4& color);

/// Two of them, one at infinity.
osg::ref_ptr<osg::Group> lights();

/// A table of boxes that throw shadows on each other and on the ground, all before the mirror.
osg::ref_ptr<osg::Group> things();

/// A wall that leans, so that no axis is along it.
const osg::Vec3 Corner(-3.0f, 1.0f, 0.2f), Along(6.0f, 0.8f, 0.0f), Up(0.1f, -0.4f, 3.5f);

/// `mirror` is its description; empty for a wall that reflects nothing.
osg::ref_ptr<osg::Geode> wall(const std::string& mirror = "mirror=1");

/// Where a mirror in the wall shows things.
osg::ref_ptr<osg::MatrixTransform> behindWall();

const unsigned char* pixel(const osg::Image& image, int x, int y);

bool isAlike(const unsigned char* a, const unsigned char* b, int tolerance);

/// A picture of where the wall is seen: white there, black elsewhere.
osg::ref_ptr<osg::Image> wallMask(const support::CameraSpec& from = camera());

/// A camera before a single mirror and nothing else.
osg::ref_ptr<osgShadowVolume::ShadowedScene> wallScene(const osg::ref_ptr<osg::Geode>& mirror);

/// The plan of the view, not of what a mirror shows.
osgMultiRender::Plan planOf(const osgShadowVolume::ShadowedScene& scene);

/// Why the plan decides so on a subject; "" where it does not.
std::string reasonOf(const osgShadowVolume::ShadowedScene& scene, const std::string& subject,
                     osgMultiRender::PlanEntry::Decision decision);

/// Pictures of mirrors that were drawn; -1 where the plan does not speak of mirrors.
double passesOf(const osgShadowVolume::ShadowedScene& scene);

} // namespace mirrorScene
