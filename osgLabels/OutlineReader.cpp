// SPDX-License-Identifier: MIT
#include <osgLabels/OutlineReader.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// Of flattened curves, in 26.6 units at 1024 pixels an em: 1e-4 em.
constexpr double Tolerance = 6.0;

glm::vec2 toPoint(const FT_Vector* vector)
{
    return {static_cast<float>(vector->x), static_cast<float>(vector->y)};
}

std::vector<glm::vec2>& getContour(void* outline)
{
    return static_cast<GlyphOutline*>(outline)->contours.back();
}

int moveTo(const FT_Vector* to, void* outline)
{
    static_cast<GlyphOutline*>(outline)->contours.push_back({toPoint(to)});
    return 0;
}

int lineTo(const FT_Vector* to, void* outline)
{
    getContour(outline).push_back(toPoint(to));
    return 0;
}

/// Sides for a curve whose control points bend by `bend`: a parabola's error falls with the square.
int getSides(double bend)
{
    return std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / Tolerance))), 1, 64);
}

int conicTo(const FT_Vector* control, const FT_Vector* to, void* outline)
{
    auto& contour = getContour(outline);
    const glm::vec2 a = contour.back(), b = toPoint(control), c = toPoint(to);
    const glm::vec2 second = a - 2.0f * b + c;
    const int sides = getSides(std::hypot(second.x, second.y) / 4.0);
    for (int i = 1; i <= sides; ++i)
    {
        const float t = static_cast<float>(i) / static_cast<float>(sides), s = 1.0f - t;
        contour.push_back(s * s * a + 2.0f * s * t * b + t * t * c);
    }
    return 0;
}

int cubicTo(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to,
            void* outline)
{
    auto& contour = getContour(outline);
    const glm::vec2 a = contour.back(), b = toPoint(control1), c = toPoint(control2),
                    d = toPoint(to);
    const glm::vec2 first = a - 2.0f * b + c, second = b - 2.0f * c + d;
    const int sides =
        getSides(0.75 * std::max(std::hypot(first.x, first.y), std::hypot(second.x, second.y)));
    for (int i = 1; i <= sides; ++i)
    {
        const float t = static_cast<float>(i) / static_cast<float>(sides), s = 1.0f - t;
        contour.push_back(s * s * s * a + 3.0f * s * s * t * b + 3.0f * s * t * t * c +
                          t * t * t * d);
    }
    return 0;
}

bool isSet(const FT_Bitmap& bitmap, unsigned int x, unsigned int y)
{
    const unsigned char* const row = bitmap.buffer + static_cast<std::ptrdiff_t>(y) * bitmap.pitch;
    switch (bitmap.pixel_mode)
    {
    case FT_PIXEL_MODE_MONO:
        return row[x / 8] & (0x80u >> x % 8);
    case FT_PIXEL_MODE_GRAY:
        return row[x] >= 128;
    case FT_PIXEL_MODE_BGRA:
        return row[4 * x + 3] >= 128;
    default:
        return false;
    }
}

/// Runs of pixels of a row become one rectangle.
GlyphOutline traceBitmap(const FT_GlyphSlotRec& slot)
{
    GlyphOutline outline;
    const FT_Bitmap& bitmap = slot.bitmap;
    for (unsigned int y = 0; y < bitmap.rows; ++y)
        for (unsigned int x = 0; x < bitmap.width; ++x)
        {
            const unsigned int start = x;
            while (x < bitmap.width && isSet(bitmap, x, y))
                ++x;
            if (x == start)
                continue;
            const float left =
                            64.0f * static_cast<float>(slot.bitmap_left + static_cast<int>(start)),
                        right = 64.0f * static_cast<float>(slot.bitmap_left + static_cast<int>(x)),
                        top = 64.0f * static_cast<float>(slot.bitmap_top - static_cast<int>(y));
            outline.contours.push_back(
                {{left, top - 64.0f}, {right, top - 64.0f}, {right, top}, {left, top}});
        }
    return outline;
}

} // namespace

std::int32_t getLoadFlags(const FT_FaceRec_* face)
{
    return FT_IS_SCALABLE(face) ? FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP : FT_LOAD_DEFAULT;
}

GlyphOutline readOutline(FT_FaceRec_* face, std::uint32_t glyph)
{
    GlyphOutline outline;
    if (FT_Load_Glyph(face, glyph, getLoadFlags(face)))
        return outline;
    if (face->glyph->format == FT_GLYPH_FORMAT_BITMAP)
        return traceBitmap(*face->glyph);
    if (face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
        return outline;
    const FT_Outline_Funcs functions = {moveTo, lineTo, conicTo, cubicTo, 0, 0};
    if (FT_Outline_Decompose(&face->glyph->outline, &functions, &outline))
        outline.contours.clear();
    return outline;
}

} // namespace osgLabels
