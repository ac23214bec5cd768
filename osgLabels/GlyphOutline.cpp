// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphOutline.h>

#include <glm/common.hpp>

namespace osgLabels
{

void GlyphOutline::append(const GlyphOutline& other, const glm::vec2& offset)
{
    for (std::vector<glm::vec2> contour : other.contours)
    {
        for (glm::vec2& point : contour)
            point += offset;
        contours.push_back(std::move(contour));
    }
}

void GlyphOutline::transform(const glm::vec2& scale, const glm::vec2& offset)
{
    for (std::vector<glm::vec2>& contour : contours)
        for (glm::vec2& point : contour)
            point = point * scale + offset;
}

void GlyphOutline::clamp(const glm::vec2& low, const glm::vec2& high)
{
    for (std::vector<glm::vec2>& contour : contours)
        for (glm::vec2& point : contour)
            point = glm::clamp(point, low, high);
}

OutlineBounds getBounds(const GlyphOutline& outline)
{
    OutlineBounds bounds;
    bool isFirst = true;
    for (const std::vector<glm::vec2>& contour : outline.contours)
        for (const glm::vec2& point : contour)
        {
            bounds.low = isFirst ? point : glm::min(bounds.low, point);
            bounds.high = isFirst ? point : glm::max(bounds.high, point);
            isFirst = false;
        }
    return bounds;
}

} // namespace osgLabels
