// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Group>
#include <osg/LightSource>

#include <string>

/// Scenes whose illuminance can be told beforehand. Lengths are in metres times `unit`.
namespace measured
{

/// A rectangle of two triangles with the normal u x v.
osg::ref_ptr<osg::Node> quad(const osg::Vec3& corner, const osg::Vec3& u, const osg::Vec3& v);

/// A box from `low` to `high`, normals outwards.
osg::ref_ptr<osg::Node> box(const osg::Vec3& low, const osg::Vec3& high);

/// A point light that states its intensity in a description, on for the whole of `scope`.
osg::ref_ptr<osg::LightSource> pointLight(int number, const osg::Vec3& position,
                                          const std::string& description, osg::Node& scope);

/// Down-looking spot light.
osg::ref_ptr<osg::LightSource> spotLight(int number, const osg::Vec3& position, float cutoff,
                                         float exponent, const std::string& description,
                                         osg::Node& scope);

/// The same at infinity; `toLight` points to the light.
osg::ref_ptr<osg::LightSource> sun(int number, const osg::Vec3& toLight,
                                   const std::string& description, osg::Node& scope);

/// A closed room of 8 x 6 x 3 m seen from inside, with a desk of 1.6 x 0.8 m at a height of 0.75 m
/// around (4, 3), and a lamp of 1000 cd at (4, 3, 2.5). States its scale: `metres` a unit.
osg::ref_ptr<osg::Group> classRoom(double metres = 1.0);

} // namespace measured
