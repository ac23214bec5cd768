// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FontFace.h>

#include <memory>
#include <string>
#include <vector>

namespace osgLabels
{

struct ShapedGlyph
{
    std::uint32_t glyph = 0;
    glm::vec2 offset{0.0f}; ///< From the start of its cluster on the baseline, in em.
};

/// What is drawn as one: a letter with its combining marks, a ligature.
struct ShapedCluster
{
    std::vector<ShapedGlyph> glyphs;
    float advance = 0.0f;  ///< em
    std::size_t begin = 0; ///< Its characters in the text.
    std::size_t end = 0;
};

/// Turns characters into glyphs, by HarfBuzz where the library was built with it; else letter by
/// letter, so that each combining mark stands for itself and nothing joins.
///
/// May be used from several threads.
class OSGLABELS_EXPORT TextShaper
{
public:
    explicit TextShaper(std::shared_ptr<const FontFace> face);
    ~TextShaper();
    TextShaper(const TextShaper&) = delete;
    TextShaper& operator=(const TextShaper&) = delete;

    /// Whether marks combine: the library was built with HarfBuzz.
    static bool isShaping();

    /// Clusters from left to right as they are seen, also of text that is written from the right.
    std::vector<ShapedCluster> shape(const std::u32string& text) const;

private:
    struct Native;
    std::shared_ptr<const FontFace> _face;
    std::unique_ptr<Native> _native;
};

} // namespace osgLabels
