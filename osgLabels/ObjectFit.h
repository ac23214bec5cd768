// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/DrawableFit.h>

#include <osg/Geometry>

namespace osgLabels
{

/// The record of a drawable by its shape, or by its own texture coordinates where it has some on
/// unit `texCoord`; -1: by shape. With `scale`, see UnevenScales, in coordinates scaled by it.
ObjectRecord recordOf(const osg::Drawable& drawable, const osg::Matrixd* scale, int texCoord,
                      std::uint32_t identifier);

/// The record of a geometry in other coordinates, whatever `matrix` does to its shape.
ObjectRecord recordOf(const osg::Geometry& geometry, const osg::Matrixd& matrix, int texCoord,
                      std::uint32_t identifier);

} // namespace osgLabels
