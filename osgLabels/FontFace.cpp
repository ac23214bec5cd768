// SPDX-License-Identifier: MIT
#include <osgLabels/FontFace.h>

#include <osgLabels/OutlineReader.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace osgLabels
{

namespace
{

/// Pixels an em at which outlines are read: 26.6 numbers then hold coordinates of all font units.
constexpr FT_UInt ReadSize = 1024;

/// In em. No letter is wider, whatever a damaged file says, and no cell: images are so large.
constexpr float WidestLetter = 16.0f, WidestCell = 4.0f, NarrowestCell = 0.05f;

std::string describe(FT_Error error)
{
    // FreeType is mostly built without its texts of errors.
    const char* const text = FT_Error_String(error);
    return text ? text : "FreeType error " + std::to_string(error);
}

} // namespace

struct FontFace::Native
{
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    ~Native()
    {
        FT_Done_Face(face);
        FT_Done_FreeType(library);
    }
};

FontFace::FontFace(std::string file) : _file(std::move(file)), _native(std::make_unique<Native>())
{
}

FontFace::~FontFace() = default;

FT_FaceRec_* FontFace::getFace() const
{
    return _native->face;
}

std::shared_ptr<FontFace> FontFace::open(const std::string& file, std::string& error)
{
    const std::shared_ptr<FontFace> face(new FontFace(file));
    const std::string cause = face->load();
    if (cause.empty())
        return face;
    error = "font '" + file + "': " + cause;
    return nullptr;
}

std::shared_ptr<FontFace> FontFace::openOrDefault(const std::string& file, std::string& error)
{
    error.clear();
    if (!file.empty())
        if (std::shared_ptr<FontFace> face = open(file, error))
            return face;
    static const char* const folders[] = {
        "/usr/share/fonts/truetype/", "/usr/share/fonts/", "/usr/share/fonts/TTF/",
        "/usr/local/share/fonts/",    "/Library/Fonts/",   "/System/Library/Fonts/",
        "C:/Windows/Fonts/"};
    static const char* const names[] = {"dejavu/DejaVuSansMono.ttf",
                                        "DejaVuSansMono.ttf",
                                        "liberation/LiberationMono-Regular.ttf",
                                        "liberation-mono/LiberationMono-Regular.ttf",
                                        "noto/NotoSansMono-Regular.ttf",
                                        "freefont/FreeMono.ttf",
                                        "Menlo.ttc",
                                        "consola.ttf"};
    std::string ignored;
    for (const char* const name : names)
        for (const char* const folder : folders)
            if (std::shared_ptr<FontFace> face = open(std::string(folder) + name, ignored))
                return face;
    error += error.empty() ? "" : "; ";
    error += "no default font found, no text is shown: install DejaVu Sans Mono (Debian: "
             "fonts-dejavu-core) or name a font file";
    return nullptr;
}

std::string FontFace::load()
{
    if (!std::ifstream(_file))
        return "no such file, or it cannot be read";
    if (const FT_Error error = FT_Init_FreeType(&_native->library))
        return describe(error);
    if (const FT_Error error = FT_New_Face(_native->library, _file.c_str(), 0, &_native->face))
        return "not a font that FreeType opens: " + describe(error);
    const FT_Face face = _native->face;
    double height = 0.0, descent = 0.0; // 26.6 units
    if (FT_IS_SCALABLE(face))
    {
        if (const FT_Error error = FT_Set_Pixel_Sizes(face, 0, ReadSize))
            return describe(error);
        const double unit = 64.0 * ReadSize / std::max<int>(1, face->units_per_EM);
        descent = -face->descender * unit;
        height = face->ascender * unit + descent;
    }
    else if (face->num_fixed_sizes > 0)
    {
        const auto* const sizes = face->available_sizes;
        const auto* const largest = std::max_element(
            sizes, sizes + face->num_fixed_sizes,
            [](const FT_Bitmap_Size& a, const FT_Bitmap_Size& b) { return a.height < b.height; });
        if (const FT_Error error = FT_Select_Size(face, static_cast<FT_Int>(largest - sizes)))
            return describe(error);
        descent = static_cast<double>(-face->size->metrics.descender);
        height = static_cast<double>(face->size->metrics.ascender) + descent;
    }
    const double em = 64.0 * std::max<int>(1, face->size->metrics.y_ppem);
    // Broken metrics: the font's own em, with the usual share of descenders.
    if (height < 0.2 * em || height > 8.0 * em || std::abs(descent) > height)
    {
        height = em;
        descent = 0.2 * height;
    }
    _scale = static_cast<float>(1.0 / height);
    _baseline = static_cast<float>(descent / height);
    // Symbol fonts have no Unicode table; their own is taken as it is.
    if (!face->charmap && face->num_charmaps > 0)
        FT_Set_Charmap(face, face->charmaps[0]);
    return {};
}

std::string FontFace::getName() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const FT_Face face = _native->face;
    std::string name = face->family_name ? face->family_name : "unnamed";
    if (face->style_name)
        name += std::string(" ") + face->style_name;
    return name;
}

bool FontFace::isMonospaced() const
{
    return FT_IS_FIXED_WIDTH(_native->face);
}

std::uint32_t FontFace::getGlyph(char32_t character) const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return FT_Get_Char_Index(_native->face, character);
}

float FontFace::getAdvanceLocked(std::uint32_t glyph) const
{
    if (FT_Load_Glyph(_native->face, glyph, getLoadFlags(_native->face)))
        return 0.0f;
    const float advance = static_cast<float>(_native->face->glyph->advance.x) * _scale;
    return std::clamp(advance, 0.0f, WidestLetter);
}

float FontFace::getAdvance(std::uint32_t glyph) const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return getAdvanceLocked(glyph);
}

float FontFace::getCellAdvance() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    float widest = 0.0f;
    for (FT_ULong character = ' '; character <= '~'; ++character)
        if (const FT_UInt glyph = FT_Get_Char_Index(_native->face, character))
            widest = std::max(widest, getAdvanceLocked(glyph));
    // A font without Latin letters: its own widest glyph, but no wider than a line is high.
    const float all = static_cast<float>(_native->face->size->metrics.max_advance) * _scale;
    const float cell = widest > 0.0f ? widest : all > 0.0f ? std::min(all, 1.0f) : 0.5f;
    return std::clamp(cell, NarrowestCell, WidestCell);
}

GlyphOutline FontFace::getOutline(std::uint32_t glyph) const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    GlyphOutline outline = readOutline(_native->face, glyph);
    outline.transform(glm::vec2(_scale), glm::vec2(0.0f, _baseline));
    return outline;
}

} // namespace osgLabels
