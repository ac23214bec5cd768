// SPDX-License-Identifier: MIT
#include <osgLabels/Placement.h>

#include <osgLabels/Shaders.h>

#include <glm/glm.hpp>

namespace osgLabels
{

/// The shader's own text.
namespace glsl
{
using namespace glm;
// The files' names are their order: structures and faces first.
#include <osgLabels/shaders/placementFaces.glsl>

#include <osgLabels/shaders/placement.glsl>
} // namespace glsl

LabelPlace placeOn(const ObjectRecord& record, const glm::vec3& position, const glm::vec3& dx,
                   const glm::vec3& dy, const PlacementView& view, float width)
{
    const glm::quat& q = record.rotation;
    const glsl::osgLabels_Object object{
        {q.x, q.y, q.z, q.w}, record.origin, record.shape, record.size, record.identifier};
    const glsl::osgLabels_View seen{view.eye,    view.up,  view.screenUp, view.screenRight,
                                    view.height, view.gap, view.base};
    const glsl::osgLabels_Place at = glsl::osgLabels_placeOn(object, position, dx, dy, seen, width);
    return {at.inside, at.place, at.footprint, {at.onLine[0], at.onLine[1], at.onLine[2]}};
}

std::string placementSource()
{
    return std::string(shaders::placementFaces_glsl) + shaders::placement_glsl;
}

} // namespace osgLabels
