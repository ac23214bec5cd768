// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphOutline.h>

#include <cstdint>

struct FT_FaceRec_;

namespace osgLabels
{

/// How glyphs are to be loaded: without hinting, which fits letters to one pixel grid only.
std::int32_t getLoadFlags(const FT_FaceRec_* face);

/// The glyph's outline in FreeType's 26.6 units; a bitmap font's pixels become rectangles. Empty
/// where the glyph cannot be loaded.
GlyphOutline readOutline(FT_FaceRec_* face, std::uint32_t glyph);

} // namespace osgLabels
