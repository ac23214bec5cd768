// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FitMesh.h>

namespace osgLabels
{

/// How much of each pair of faces of a shape's box text may use, so that it is cut nowhere: the
/// largest rectangle around the middle of the face, of its proportions, in
/// FittedShape::FullRoom-ths of it. In it the mesh has no hole, no step and no edge that folds by
/// more than 40 degrees, and shows nothing that is labelled from another side. Both faces of a pair
/// get what the poorer one has; one that the mesh leaves out does not count. 0 where less than a
/// fifth remains.
glm::uvec3 faceRooms(const FitMesh& mesh, const FittedShape& shape);

} // namespace osgLabels
