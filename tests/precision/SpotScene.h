// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Group>

namespace precision
{

enum class Lighting
{
    FixedFunction, ///< OpenGL's own, per vertex.
    PerPixel       ///< osgShadowVolume::LitScene.
};

/// An empty group that lights its children that way.
osg::ref_ptr<osg::Group> makeLitScene(Lighting lighting);

/// A floor of 4 x 4 units at z = 0 in floorCells x floorCells cells, 1 to 1024, with a sphere of
/// radius 0.5 on it, under one spot light (GL_LIGHT1) from above. The sphere is the same for all.
osg::ref_ptr<osg::Group> makeSpotScene(int floorCells);

} // namespace precision
