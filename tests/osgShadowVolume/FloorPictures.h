// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/ShadowedScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/Geode>
#include <osg/LightSource>

#include <functional>
#include <string>

/// Pictures of shadows on a floor, seen from above, where geometry says what is in shadow.
namespace floorScene
{

constexpr int Width = 256, Height = 256;

/// A floor z = 0 from -4 to 4, seen from above in full: pixels are places on it.
support::CameraSpec fromAbove();

osg::Vec2d placeOf(int x, int y);

osg::ref_ptr<osg::Geode> rectangle(const osg::Vec3& corner, const osg::Vec3& width,
                                   const osg::Vec3& height);

osg::ref_ptr<osg::Geode> floorGeode();

/// A square of side 2 around the z axis, turned by 30 degrees so that no texel runs along it.
osg::ref_ptr<osg::Geode> occluder(double z);

bool isUnderOccluder(const osg::Vec2d& p);

/// A light without ambient and specular parts.
osg::ref_ptr<osg::LightSource> lightSource(unsigned int number, const osg::Vec4& position,
                                           float brightness = 1.0f);

/// All lights shine on it, by shadow maps; shadows are black.
osg::ref_ptr<osgShadowVolume::ShadowedScene> shadowed();

/// Of this process, without a light of its own.
support::HeadlessViewer& viewer();

osg::ref_ptr<osg::Image> picture(osgShadowVolume::ShadowedScene& scene,
                                 const support::CameraSpec& camera);

int red(const osg::Image& image, int x, int y);

/// The share of pixels that are dark where `inShadow` says lit, or the other way round.
double wrongShare(const osg::Image& image, const std::function<bool(const osg::Vec2d&)>& inShadow);

/// The decision and reason on a subject, or "" where the plan does not name it.
std::string entryOf(const osgMultiRender::Plan& plan, const std::string& subject);

} // namespace floorScene
