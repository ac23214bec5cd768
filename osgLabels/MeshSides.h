// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/Drawable>

#include <cstdint>

namespace osgLabels
{

/// Which sides of a mesh say where a ray leaves what it stands for.
enum class MeshSides
{
    Open,    ///< An edge lacks its opposite partner: it has no inside, both sides count.
    Outward, ///< Closed; triangles are counterclockwise from outside.
    Inward   ///< Closed; clockwise.
};

/// Looks at all triangles, in their local coordinates; corners at one place, but for
/// rounding, are one. Closed is a
/// mesh whose edges all have a partner that runs the other way. Points and lines are open.
OSGLABELS_EXPORT MeshSides sidesOf(const osg::Drawable& drawable);

/// Another number when vertices or primitives of a Geometry are exchanged or dirtied; 0 of others.
OSGLABELS_EXPORT std::uint64_t stampOf(const osg::Drawable& drawable);

} // namespace osgLabels
