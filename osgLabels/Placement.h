// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/ObjectRecord.h>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <string>

namespace osgLabels
{

/// How a labelled object is seen, in its local coordinates.
struct PlacementView
{
    glm::vec4 eye{0.0f, 0.0f, 1.0f, 0.0f}; ///< From the record's origin; w = 0: a direction.
    glm::vec3 up{0.0f};                    ///< Of the world; 0 where it has none.
    glm::vec3 screenUp{0.0f, 1.0f, 0.0f};
    glm::vec3 screenRight{1.0f, 0.0f, 0.0f};
    float height = 0.5f; ///< Of text, as a share of the room across its line; at most 0.9.
    float gap = 2.0f;    ///< Least gap between repetitions, in em.
    /// What positions are relative to, from the record's origin. The same for all points of an
    /// object; near the eye it keeps text exact on objects that are long beyond floats.
    glm::vec3 base{0.0f};
};

/// A point of a surface on its label.
struct LabelPlace
{
    bool inside = false;       ///< Whether it is on a text.
    glm::vec2 place{0.0f};     ///< In em: x from 0 to the text's width, y from 0 to 1.
    glm::mat2 footprint{0.0f}; ///< d(place)/dx and d(place)/dy.
    /// Where the text's line is a sixth, half and five sixths of the way, given as `position` is;
    /// up to rounding the same from everywhere on the text.
    std::array<glm::vec3, 3> onLine{};
};

/// Where text of `width` em lies at a point of an object. `position` is relative to the record's
/// origin and view.base; `dx` and `dy` are its changes by a pixel to the right and up. The same
/// source as osgLabels_placeOn() of placement.glsl. Finite input gives finite places where text is.
OSGLABELS_EXPORT LabelPlace placeOn(const ObjectRecord& record, const glm::vec3& position,
                                    const glm::vec3& dx, const glm::vec3& dy,
                                    const PlacementView& view, float width);

/// The GLSL source of osgLabels_placeOn(), without a version line. Needs GLSL 3.30.
OSGLABELS_EXPORT std::string placementSource();

} // namespace osgLabels
