// SPDX-License-Identifier: MIT
#include <osgLabels/TextShaper.h>

#ifdef OSGLABELS_HARFBUZZ
#include <hb-ft.h>
#endif

#include <algorithm>

namespace osgLabels
{

#ifdef OSGLABELS_HARFBUZZ

struct TextShaper::Native
{
    explicit Native(FT_FaceRec_* face) : font(hb_ft_font_create_referenced(face))
    {
        hb_ft_font_set_load_flags(font, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
    }
    ~Native()
    {
        hb_buffer_destroy(buffer);
        hb_font_destroy(font);
    }

    hb_font_t* font;
    hb_buffer_t* buffer = hb_buffer_create();
};

TextShaper::TextShaper(std::shared_ptr<const FontFace> face) : _face(std::move(face))
{
    const std::lock_guard<std::mutex> lock(_face->getMutex());
    // HarfBuzz reads sizes of outlines; the squares of a bitmap font are placed letter by letter.
    if (FT_IS_SCALABLE(_face->getFace()))
        _native = std::make_unique<Native>(_face->getFace());
}

TextShaper::~TextShaper()
{
    const std::lock_guard<std::mutex> lock(_face->getMutex());
    _native.reset();
}

bool TextShaper::isShaping()
{
    return true;
}

#else

struct TextShaper::Native
{
};

TextShaper::TextShaper(std::shared_ptr<const FontFace> face) : _face(std::move(face)) {}
TextShaper::~TextShaper() = default;
bool TextShaper::isShaping()
{
    return false;
}

#endif

namespace
{

std::vector<ShapedCluster> placeLetters(const FontFace& face, const std::u32string& text)
{
    std::vector<ShapedCluster> clusters(text.size());
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const std::uint32_t glyph = face.getGlyph(text[i]);
        clusters[i] = {{{glyph, glm::vec2(0.0f)}}, face.getAdvance(glyph), i, i + 1};
    }
    return clusters;
}

#ifdef OSGLABELS_HARFBUZZ

/// HarfBuzz gives each cluster the index of its first character; the others up to the next
/// cluster's first are its own.
void setEnds(std::vector<ShapedCluster>& clusters, std::size_t textSize)
{
    std::vector<std::size_t> begins;
    for (const ShapedCluster& cluster : clusters)
        begins.push_back(cluster.begin);
    std::sort(begins.begin(), begins.end());
    for (ShapedCluster& cluster : clusters)
    {
        const auto next = std::upper_bound(begins.begin(), begins.end(), cluster.begin);
        cluster.end = next == begins.end() ? textSize : *next;
    }
}

#endif

} // namespace

std::vector<ShapedCluster> TextShaper::shape(const std::u32string& text) const
{
    if (!_native)
        return placeLetters(*_face, text);
    std::vector<ShapedCluster> clusters;
#ifdef OSGLABELS_HARFBUZZ
    const std::lock_guard<std::mutex> lock(_face->getMutex());
    hb_buffer_t* const buffer = _native->buffer;
    hb_buffer_clear_contents(buffer);
    hb_buffer_set_cluster_level(buffer, HB_BUFFER_CLUSTER_LEVEL_MONOTONE_GRAPHEMES);
    const auto size = static_cast<int>(text.size());
    hb_buffer_add_utf32(buffer, reinterpret_cast<const std::uint32_t*>(text.data()), size, 0, size);
    hb_buffer_guess_segment_properties(buffer);
    // Kerning would make a glyph of its own of each pair of letters.
    const hb_feature_t noKerning = {HB_TAG('k', 'e', 'r', 'n'), 0, 0, ~0u};
    hb_shape(_native->font, buffer, &noKerning, 1);
    unsigned int count = 0;
    const hb_glyph_info_t* const infos = hb_buffer_get_glyph_infos(buffer, &count);
    const hb_glyph_position_t* const positions = hb_buffer_get_glyph_positions(buffer, nullptr);
    const float scale = _face->getScale();
    for (unsigned int i = 0; i < count; ++i)
    {
        if (clusters.empty() || clusters.back().begin != infos[i].cluster)
        {
            clusters.emplace_back();
            clusters.back().begin = infos[i].cluster;
        }
        ShapedCluster& cluster = clusters.back();
        const glm::vec2 offset = scale * glm::vec2(positions[i].x_offset, positions[i].y_offset);
        cluster.glyphs.push_back({infos[i].codepoint, offset + glm::vec2(cluster.advance, 0.0f)});
        cluster.advance += scale * static_cast<float>(positions[i].x_advance);
    }
    setEnds(clusters, text.size());
#endif
    return clusters;
}

} // namespace osgLabels
