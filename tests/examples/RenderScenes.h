// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

#include <string>

/// Scenes whose pictures can be told beforehand.
namespace scenes
{

/// An unlit square of side 2 in the plane y = 0, around the origin, seen from both sides.
osg::ref_ptr<osg::Node> square(const osg::Vec4& color);

/// The square with a material that emits `color` under lighting, for values above 1.
osg::ref_ptr<osg::Node> glowingSquare(const osg::Vec3& color);

/// The square moving along x by one unit a second.
osg::ref_ptr<osg::Node> movingSquare(const osg::Vec4& color);

/// A square that is replaced by the one in `file` as soon as that is loaded.
osg::ref_ptr<osg::Node> pagedSquare(const osg::Vec4& color, const std::string& file);

/// The square under a light whose number OpenGL does not know.
osg::ref_ptr<osg::Node> squareWithLight(int number);

void write(const osg::Node& scene, const std::string& file);

} // namespace scenes
