// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/ShapeFit.h>

#include <osg/Drawable>

namespace osgLabels
{

/// The shape of a drawable. An osg::ShapeDrawable's own Box, Sphere, Cylinder and Cone are taken as
/// they are, a Capsule is a projected Cylinder; all else goes by its triangles (see fitShape()).
/// None for points, lines and what has no triangles. Reads the drawable, so call it where nobody
/// writes it.
OSGLABELS_EXPORT FittedShape fitDrawable(const osg::Drawable& drawable);

} // namespace osgLabels
