// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/TextShaper.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace osgLabels
{

enum class Spacing
{
    Cells,       ///< Each glyph takes a cell of the same width: the font's advance.
    Proportional ///< Each glyph takes its own advance. No kerning.
};

/// One image of the atlas: a shaped cluster of characters.
struct Glyph
{
    GlyphOutline outline; ///< x from 0 at the left of its cell to the advance.
    float advance = 0.0f; ///< em
};

/// Numbers the glyphs that a scene uses: 0, 1, 2, … in the order in which texts bring them.
///
/// In cells a glyph that is narrower stands in the middle, one that is wider is squeezed. Control
/// characters are shown as spaces. May be used from several threads.
class OSGLABELS_EXPORT GlyphSet
{
public:
    /// `report` gets one line for each character that the font lacks, once each; it is called from
    /// the thread that calls codesOf(). The font's own box stands for the character.
    using Report = std::function<void(const std::string& line)>;

    explicit GlyphSet(std::shared_ptr<const FontFace> face, Spacing spacing = Spacing::Cells,
                      Report report = {});

    /// The glyphs of a text from left to right; new ones get their codes.
    /// ASCII takes no shaping, so no ligatures, and no lock once its letters are known.
    std::vector<std::uint32_t> codesOf(const std::string& utf8);

    /// As codesOf(), into a vector that is used again.
    void appendCodes(const std::string& utf8, std::vector<std::uint32_t>& codes);

    /// How many codes there are: all below are valid, and none is ever taken back.
    std::uint32_t getSize() const;

    /// Throws std::out_of_range for a code that was never given.
    std::shared_ptr<const Glyph> getGlyph(std::uint32_t code) const;

    Spacing getSpacing() const { return _spacing; }

    /// Width of a cell in em; in proportional text that of its widest ASCII letter.
    float getCellAdvance() const { return _cellAdvance; }

    const FontFace& getFace() const { return *_face; }

private:
    std::uint32_t getAsciiCode(unsigned char character);
    std::uint32_t add(const ShapedCluster& cluster);
    std::shared_ptr<const Glyph> make(const ShapedCluster& cluster) const;
    void reportMissing(const std::u32string& text, const ShapedCluster& cluster);

    const std::shared_ptr<const FontFace> _face;
    const TextShaper _shaper;
    const Spacing _spacing;
    const Report _report;
    const float _cellAdvance;
    static constexpr std::uint32_t NoCode = ~0u;
    std::array<std::atomic<std::uint32_t>, 128> _ascii;
    mutable std::mutex _mutex;                   ///< Of all below.
    std::map<std::string, std::uint32_t> _codes; ///< By the bytes of the cluster's glyphs.
    std::vector<std::shared_ptr<const Glyph>> _glyphs;
    std::set<char32_t> _reported;
};

} // namespace osgLabels
