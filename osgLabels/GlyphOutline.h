// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <glm/vec2.hpp>

#include <vector>

namespace osgLabels
{

/// The outline of a glyph as closed polygons, filled where the winding number is not 0.
///
/// In em: the line's height is 1, y runs from 0 at the descender to 1 at the ascender, x from 0 at
/// the left of the glyph's cell. Curves are flattened to within 1e-4 em.
struct OSGLABELS_EXPORT GlyphOutline
{
    std::vector<std::vector<glm::vec2>> contours;

    void append(const GlyphOutline& other, const glm::vec2& offset);

    /// Each point becomes point * scale + offset.
    void transform(const glm::vec2& scale, const glm::vec2& offset);

    /// Moves points that lie outside of a rectangle onto its sides.
    void clamp(const glm::vec2& low, const glm::vec2& high);
};

struct OutlineBounds
{
    glm::vec2 low{0.0f}, high{0.0f}; ///< Both 0 without points.
};

OSGLABELS_EXPORT OutlineBounds getBounds(const GlyphOutline& outline);

} // namespace osgLabels
