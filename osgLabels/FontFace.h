// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphOutline.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

struct FT_FaceRec_;

namespace osgLabels
{

/// A font file: its characters, their advances and outlines, by FreeType.
///
/// All lengths are in em, where 1 em is the line's height from the descender to the ascender. Any
/// file that FreeType opens is taken; of fonts without outlines the pixels of the largest strike
/// become squares. May be used from several threads.
class OSGLABELS_EXPORT FontFace
{
public:
    /// Null, with the file and the cause in `error`, where the file is missing or no font.
    static std::shared_ptr<FontFace> open(const std::string& file, std::string& error);

    /// Opens `file`, or where it is empty or fails the default: DejaVu Sans Mono, or the first
    /// monospaced font found in the system's usual folders. `error` then says what was wrong with
    /// `file`; empty otherwise. Null where there is no font at all: no text can be shown then.
    static std::shared_ptr<FontFace> openOrDefault(const std::string& file, std::string& error);

    ~FontFace();
    FontFace(const FontFace&) = delete;
    FontFace& operator=(const FontFace&) = delete;

    const std::string& getFile() const { return _file; }

    /// Family and style, "DejaVu Sans Mono Book".
    std::string getName() const;

    bool isMonospaced() const;

    /// The font's glyph for a character; 0, the font's box for what it lacks, where there is none.
    std::uint32_t getGlyph(char32_t character) const;

    float getAdvance(std::uint32_t glyph) const;

    /// The widest advance of the printable ASCII characters: that of all of them in a monospaced
    /// font.
    float getCellAdvance() const;

    /// Empty for spaces, and for glyphs that the file does not hold intact.
    GlyphOutline getOutline(std::uint32_t glyph) const;

    /// em per font unit, as the FreeType face and HarfBuzz give positions at this face's size.
    float getScale() const { return _scale; }

    /// FreeType's face. Hold the mutex while using it.
    FT_FaceRec_* getFace() const;
    std::mutex& getMutex() const { return _mutex; }

private:
    struct Native;
    explicit FontFace(std::string file);
    std::string load();
    float getAdvanceLocked(std::uint32_t glyph) const;

    std::string _file;
    std::unique_ptr<Native> _native;
    float _scale = 1.0f;    ///< em per 26.6 unit at the size that was chosen.
    float _baseline = 0.0f; ///< Height of the baseline in em.
    mutable std::mutex _mutex;
};

} // namespace osgLabels
