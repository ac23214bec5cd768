// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphSet.h>

#include <osgLabels/Utf8.h>

#include <algorithm>
#include <cstdio>

namespace osgLabels
{

namespace
{

/// In em: what damaged fonts may not exceed. Images show letters up to the second.
constexpr float Widest = 16.0f, WidestImage = 4.0f;

/// What the same glyphs at the same offsets have in common. A glyph alone in its place is the same
/// whether it was shaped or not, however its advance was rounded.
std::string getKey(const ShapedCluster& cluster)
{
    std::string key;
    const bool isAlone = cluster.glyphs.size() == 1 && cluster.glyphs[0].offset == glm::vec2(0.0f);
    if (isAlone)
        return {reinterpret_cast<const char*>(&cluster.glyphs[0].glyph), sizeof(std::uint32_t)};
    const auto append = [&key](const auto& value)
    { key.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(cluster.advance);
    for (const ShapedGlyph& glyph : cluster.glyphs)
    {
        append(glyph.glyph);
        append(glyph.offset.x);
        append(glyph.offset.y);
    }
    return key;
}

bool isAscii(const std::string& text)
{
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 128; });
}

} // namespace

GlyphSet::GlyphSet(std::shared_ptr<const FontFace> face, Spacing spacing, Report report)
    : _face(std::move(face)), _shaper(_face), _spacing(spacing), _report(std::move(report)),
      _cellAdvance(_face->getCellAdvance())
{
    for (std::atomic<std::uint32_t>& code : _ascii)
        code.store(NoCode, std::memory_order_relaxed);
}

std::vector<std::uint32_t> GlyphSet::codesOf(const std::string& utf8)
{
    std::vector<std::uint32_t> codes;
    appendCodes(utf8, codes);
    return codes;
}

void GlyphSet::appendCodes(const std::string& utf8, std::vector<std::uint32_t>& codes)
{
    if (isAscii(utf8))
    {
        codes.reserve(codes.size() + utf8.size());
        for (const char c : utf8)
            codes.push_back(getAsciiCode(static_cast<unsigned char>(c)));
        return;
    }
    std::u32string text = decodeUtf8(utf8);
    for (char32_t& character : text)
        if (character < ' ' || character == 0x7F)
            character = ' ';
    for (const ShapedCluster& cluster : _shaper.shape(text))
    {
        codes.push_back(add(cluster));
        reportMissing(text, cluster);
    }
}

std::uint32_t GlyphSet::getAsciiCode(unsigned char character)
{
    std::atomic<std::uint32_t>& known = _ascii[character];
    std::uint32_t code = known.load(std::memory_order_acquire);
    if (code != NoCode)
        return code;
    const char32_t shown = character < ' ' || character == 0x7F ? ' ' : character;
    const std::uint32_t glyph = _face->getGlyph(shown);
    const ShapedCluster cluster = {{{glyph, glm::vec2(0.0f)}}, _face->getAdvance(glyph), 0, 1};
    code = add(cluster);
    reportMissing(std::u32string(1, shown), cluster);
    known.store(code, std::memory_order_release);
    return code;
}

std::uint32_t GlyphSet::add(const ShapedCluster& cluster)
{
    const std::string key = getKey(cluster);
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        const auto found = _codes.find(key);
        if (found != _codes.end())
            return found->second;
    }
    // Outlines are read outside the lock; where two threads make the same one, the first counts.
    std::shared_ptr<const Glyph> glyph = make(cluster);
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto [entry, isNew] = _codes.emplace(key, static_cast<std::uint32_t>(_glyphs.size()));
    if (isNew)
        _glyphs.push_back(std::move(glyph));
    return entry->second;
}

std::shared_ptr<const Glyph> GlyphSet::make(const ShapedCluster& cluster) const
{
    const auto glyph = std::make_shared<Glyph>();
    for (const ShapedGlyph& part : cluster.glyphs)
        glyph->outline.append(_face->getOutline(part.glyph), part.offset);
    const OutlineBounds bounds = getBounds(glyph->outline);
    float advance = std::min(cluster.advance, Widest);
    if (!(advance > 0.0f)) // a mark alone: as wide as its ink
    {
        advance = std::clamp(bounds.high.x - bounds.low.x, 0.05f, Widest);
        glyph->outline.transform(glm::vec2(1.0f), glm::vec2(-bounds.low.x, 0.0f));
    }
    glyph->advance = advance;
    if (_spacing == Spacing::Cells)
    {
        const float scale = std::min(1.0f, _cellAdvance / advance);
        const float rest = _cellAdvance - scale * advance;
        glyph->outline.transform(glm::vec2(scale, 1.0f), glm::vec2(0.5f * rest, 0.0f));
        glyph->advance = _cellAdvance;
    }
    // Damaged fonts have points anywhere; no image reaches so far.
    glyph->outline.clamp(glm::vec2(-1.0f), {std::min(glyph->advance, WidestImage) + 1.0f, 2.0f});
    return glyph;
}

void GlyphSet::reportMissing(const std::u32string& text, const ShapedCluster& cluster)
{
    if (!_report || std::none_of(cluster.glyphs.begin(), cluster.glyphs.end(),
                                 [](const ShapedGlyph& part) { return part.glyph == 0; }))
        return;
    for (std::size_t i = cluster.begin; i < cluster.end; ++i)
    {
        if (_face->getGlyph(text[i]))
            continue;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (!_reported.insert(text[i]).second)
                continue;
        }
        char number[16];
        std::snprintf(number, sizeof number, "U+%04X", static_cast<unsigned int>(text[i]));
        _report("osgLabels::GlyphSet: font '" + _face->getFile() + "' has no glyph for " + number +
                ", its box is shown");
    }
}

std::uint32_t GlyphSet::getSize() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return static_cast<std::uint32_t>(_glyphs.size());
}

std::shared_ptr<const Glyph> GlyphSet::getGlyph(std::uint32_t code) const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _glyphs.at(code);
}

} // namespace osgLabels
