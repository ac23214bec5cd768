// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/ShapeFit.h>

#include <osg/Geometry>

namespace osgLabels
{

/// A label that follows the texture coordinates of a unit: text runs along s, its up is t.
///
/// The shape is TexCoord; its origin is the middle of the coordinates, its size half their lengths
/// on the surface, and x and y of its rotation are the mean lengths of one unit of s and t, so that
/// text is not stretched on the whole. `position` of osgLabels_placeOn() is then the fragment's
/// coordinate less the record's origin, with z = 0, and dx and dy its derivatives.
///
/// Where the coordinates do not lie flat and even in the mesh, it is bent: one place does not tell
/// where another one of the text is. Whatever has to be the same for the whole text goes by the
/// mesh's middle then, which z and w of the rotation and z of the origin hold, and by z of the
/// size, a length well within its extent.
///
/// None without coordinates for all vertices, without triangles, and where s or t is constant.
OSGLABELS_EXPORT FittedShape fitTexCoords(const osg::Geometry& geometry, unsigned int unit);

} // namespace osgLabels
