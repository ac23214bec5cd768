// SPDX-License-Identifier: MIT
// Any bytes as a font file: an error of one line, or glyphs whose images can be made. An odd number
// of bytes: letters of their own widths, else cells; every third one has outlines.
#include "fuzz/Require.h"

#include <osgLabels/GlyphImages.h>

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>

using namespace osgLabels;

namespace
{

/// Of the bytes: a file in memory, since fonts are opened by name.
std::string fileOf(const std::uint8_t* data, std::size_t size)
{
    static const int file = memfd_create("font", 0);
    require(file >= 0 && ftruncate(file, 0) == 0 &&
                pwrite(file, data, size, 0) == static_cast<ssize_t>(size),
            "there is memory for the file");
    return "/proc/self/fd/" + std::to_string(file);
}

void checkGlyph(const Glyph& glyph)
{
    require(std::isfinite(glyph.advance) && glyph.advance >= 0.0f, "advances are finite");
    for (const auto& contour : glyph.outline.contours)
        for (const glm::vec2& point : contour)
            require(std::isfinite(point.x) && std::isfinite(point.y), "outlines are finite");
}

void checkImages(const GlyphSet& glyphs, const GlyphImages& images, std::uint32_t which)
{
    require(images.getWidth() > 0 && images.getWidth() <= 8192 && images.getHeight() > 0 &&
                images.getHeight() <= 8192,
            "images fit into a texture");
    const std::size_t bytes = 4 * std::size_t(images.getWidth()) * std::size_t(images.getHeight());
    // One of them: images take most of the time.
    const std::uint32_t code = which % glyphs.getSize();
    const int image = images.getImagesPerGlyph() - 1;
    require(images.make(code, image).size() == bytes, "an image has its size");
    const float mean = images.getMeanCoverage(code, image);
    require(std::isfinite(mean) && mean >= 0.0f, "the mean coverage is a share");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string error;
    const std::shared_ptr<const FontFace> face = FontFace::open(fileOf(data, size), error);
    require(bool(face) == error.empty(), "there is a face or an error");
    if (!face)
    {
        require(error.find("font '") == 0, "an error names the file");
        require(error.find('\n') == std::string::npos, "an error is one line");
        return 0;
    }
    face->getName();
    const auto glyphs = std::make_shared<GlyphSet>(
        face, size % 2 ? Spacing::Proportional : Spacing::Cells,
        [](const std::string& line)
        { require(line.find('\n') == std::string::npos, "a message is one line"); });
    require(std::isfinite(glyphs->getCellAdvance()) && glyphs->getCellAdvance() > 0.0f,
            "cells have a width");
    for (const std::uint32_t code : glyphs->codesOf(u8"Ae\u0301fi"))
    {
        require(code < glyphs->getSize(), "codes are of the set");
        checkGlyph(*glyphs->getGlyph(code));
    }
    if (glyphs->getSize() > 0)
        checkImages(*glyphs, GlyphImages(glyphs, size % 3 ? 0.0f : 0.05f),
                    static_cast<std::uint32_t>(size / 6));
    return 0;
}
