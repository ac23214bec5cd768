// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Geometry>

/// Indexed triangle meshes with normals. Vertices are shared within a smooth surface only.
namespace plant
{

/// From -0.5 to 0.5 along each axis.
osg::ref_ptr<osg::Geometry> makeBox();

/// Of radius 1 from z = 0 to 1, with flat ends.
osg::ref_ptr<osg::Geometry> makeCylinder(int sides);

/// Of radius 1 from z = 0 to 1, with a half sphere of height `dome` on top and a flat bottom.
osg::ref_ptr<osg::Geometry> makeVessel(int sides, float dome);

/// A quarter of a torus from the x to the y axis, with open ends.
osg::ref_ptr<osg::Geometry> makeElbow(int sides, float tube);

/// A torus around z, of radius 1, with four spokes.
osg::ref_ptr<osg::Geometry> makeWheel(int sides, float tube);

/// A sheet from -0.5 to 0.5 in x and 0 to 1 in z, of rungs and two rails.
osg::ref_ptr<osg::Geometry> makeLadder(int rungs);

} // namespace plant
