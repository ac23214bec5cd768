// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphImages.h>
#include <osgLabels/InkSpans.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// Calls visit(a, b) for pieces of the side that are short enough to be border as a whole or not.
template <typename Visit> void forPieces(const glm::vec2& a, const glm::vec2& b, const Visit& visit)
{
    const float pieces = std::ceil(64.0f * glm::distance(a, b));
    for (float i = 0.0f; i < pieces; i += 1.0f)
        visit(glm::mix(a, b, i / pieces), glm::mix(a, b, (i + 1.0f) / pieces));
}

/// Calls visit(a, b) for each side of the outline that has length.
template <typename Visit> void forSides(const GlyphOutline& outline, const Visit& visit)
{
    for (const std::vector<glm::vec2>& contour : outline.contours)
        for (std::size_t i = 0; i < contour.size(); ++i)
        {
            const glm::vec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
            if (a != b)
                visit(a, b);
        }
}

/// Whether ink ends at the side. It does not where contours overlap, as those of composed letters
/// may.
bool isBorder(const InkSpans& ink, const glm::vec2& a, const glm::vec2& b)
{
    const glm::vec2 middle = 0.5f * (a + b), along = b - a;
    const float step = 2.0f / static_cast<float>(ink.getRowsPerEm());
    const glm::vec2 across = step * glm::normalize(glm::vec2(-along.y, along.x));
    return ink.contains(middle.x + across.x, middle.y + across.y) !=
           ink.contains(middle.x - across.x, middle.y - across.y);
}

float getDistanceToSide(const glm::vec2& point, const glm::vec2& a, const glm::vec2& b)
{
    const glm::vec2 along = b - a;
    const float t = glm::clamp(glm::dot(point - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::distance(point, a + t * along);
}

double getSignedArea(const GlyphOutline& outline)
{
    double area = 0.0;
    forSides(outline, [&area](const glm::vec2& a, const glm::vec2& b)
             { area += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x; });
    return 0.5 * area;
}

} // namespace

void GlyphImages::drawDistances(const GlyphOutline& outline,
                                std::vector<std::uint8_t>& pixels) const
{
    const InkSpans ink(outline, 4096);
    const glm::ivec2 size = glm::ivec2(_distance.width, _distance.height) + _quarterStep;
    const glm::vec2 border = _distance.offset - glm::vec2(_distance.x, _distance.y);
    std::vector<float> distances(static_cast<std::size_t>(size.x * size.y), DistanceSpread);
    const auto getPlace = [&](int x, int y)
    { return (glm::vec2(x, y) + 0.5f - border) / _distance.scale; };
    const auto drawPiece = [&](const glm::vec2& a, const glm::vec2& b)
    {
        if (!isBorder(ink, a, b))
            return;
        const glm::vec2 low = glm::min(a, b) - DistanceSpread,
                        high = glm::max(a, b) + DistanceSpread;
        const glm::ivec2 from(glm::max(low * _distance.scale + border, 0.0f)),
            to = glm::min(glm::ivec2(high * _distance.scale + border), size - 1);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
            {
                float& distance = distances[static_cast<std::size_t>(y * size.x + x)];
                distance = std::min(distance, getDistanceToSide(getPlace(x, y), a, b));
            }
    };
    forSides(outline, [&](const glm::vec2& a, const glm::vec2& b) { forPieces(a, b, drawPiece); });
    for (int channel = 0; channel < 4; ++channel)
        for (int y = 0; y < _distance.height; ++y)
            for (int x = 0; x < _distance.width; ++x)
            {
                const int wholeX = x + channel % 2 * _quarterStep.x,
                          wholeY = y + channel / 2 * _quarterStep.y;
                const glm::vec2 place = getPlace(wholeX, wholeY);
                const float share =
                    distances[static_cast<std::size_t>(wholeY * size.x + wholeX)] / DistanceSpread;
                const float inside = ink.contains(place.x, place.y) ? share : -share;
                const int i = (_distance.y + y) * _width + _distance.x + x;
                pixels[static_cast<std::size_t>(4 * i + channel)] =
                    static_cast<std::uint8_t>(std::lrint(127.5f + 127.5f * inside));
            }
}

GlyphOutline grow(const GlyphOutline& outline, float width)
{
    GlyphOutline grown = outline;
    if (!(width > 0.0f))
        return grown;
    // What is added winds as the ink does: against it, it would be taken away.
    const float sense = getSignedArea(outline) < 0.0 ? -1.0f : 1.0f;
    constexpr int Sides = 16;
    forSides(outline,
             [&](const glm::vec2& a, const glm::vec2& b)
             {
                 const glm::vec2 along = b - a;
                 const glm::vec2 across =
                     sense * width * glm::normalize(glm::vec2(along.y, -along.x));
                 grown.contours.push_back({a + across, b + across, b - across, a - across});
                 std::vector<glm::vec2> round;
                 for (int i = 0; i < Sides; ++i)
                 {
                     const float angle = sense * 6.2831853f * static_cast<float>(i) / Sides;
                     round.push_back(a + width * glm::vec2(std::cos(angle), std::sin(angle)));
                 }
                 grown.contours.push_back(std::move(round));
             });
    return grown;
}

} // namespace osgLabels
