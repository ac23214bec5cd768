// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/ObjectRecord.h>

#include <glm/vec3.hpp>

namespace osgLabels
{

/// A point of a surface.
struct SurfacePoint
{
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f}; ///< Of length 1; 0 where the surface has no size.
};

/// An axis-aligned box.
struct ShapeBox
{
    glm::vec3 low{0.0f}, high{0.0f};
};

/// Whether a shape has a mesh of its own: box to quad, and extrusion, which is a box here.
OSGLABELS_EXPORT bool isPrimitive(Shape shape);

/// The shape of a record without its flags.
inline Shape shapeOf(const ObjectRecord& record)
{
    return Shape(record.shape & ShapeMask);
}

/// A point of makeUnitMesh() on the object that a record says, in local coordinates. The twin of
/// osgmr_instance() in instance.vert: the same operations in floats.
OSGLABELS_EXPORT SurfacePoint placePoint(const ObjectRecord& record, const SurfacePoint& unit);

/// The object's box in the shape's own frame.
OSGLABELS_EXPORT ShapeBox shapeBox(const ObjectRecord& record);

/// The object's box in local coordinates.
OSGLABELS_EXPORT ShapeBox localBox(const ObjectRecord& record);

/// No point of the object is farther from its origin.
OSGLABELS_EXPORT float reachOf(const ObjectRecord& record);

/// The largest radius of what is round on the object; 0 for shapes with flat faces only.
OSGLABELS_EXPORT float curveOf(const ObjectRecord& record);

} // namespace osgLabels
