// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Vec3d>

#include <string>

namespace osgLabels
{

/// Text at a point of a map, facing the viewer.
struct MapLabel
{
    osg::Vec3d anchor;     ///< In the coordinates of the node that holds it.
    std::string text;      ///< UTF-8; empty shows nothing.
    double priority = 0.0; ///< Where labels overlap the larger one is shown; finite.
    std::string style;     ///< Name of one of the scene's styles; empty: the first.
    std::string feature;   ///< Name of the node that it names, which never hides it; empty: none.
};

} // namespace osgLabels
