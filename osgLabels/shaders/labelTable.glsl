// The label table: identifier -> text -> glyph codes. See LabelTable.h for the layout.
// OSGLABELS_PAGED: texture buffers are too small here, buffers are pages of 1024 x 1024 texels.

#ifdef OSGLABELS_PAGED
#define osgLabels_Buffer usampler2DArray
#else
#define osgLabels_Buffer usamplerBuffer
#endif

uniform osgLabels_Buffer osgLabels_rows;
uniform osgLabels_Buffer osgLabels_texts;
uniform osgLabels_Buffer osgLabels_styles;
uniform uvec4 osgLabels_layout; // bits of a code, shift of offsets, identifiers or log2 of the slots, probes or 0
uniform uint osgLabels_styleCount;

struct osgLabels_Text
{
    uint offset; // in codes
    int length;  // 0: no text
};

uvec4 osgLabels_texel(osgLabels_Buffer from, uint index)
{
#ifdef OSGLABELS_PAGED
    return texelFetch(from, ivec3(index & 1023u, index >> 10 & 1023u, index >> 20), 0);
#else
    return texelFetch(from, int(index));
#endif
}

uint osgLabels_bits(uint at, uint count)
{
    uint word = at >> 5u;
    uint shift = at & 31u;
    uint bits = osgLabels_texel(osgLabels_texts, word).r >> shift;
    if (shift + count > 32u)
        bits |= osgLabels_texel(osgLabels_texts, word + 1u).r << (32u - shift);
    return bits & ((1u << count) - 1u);
}

// Slot and row of an identifier; ~0 and 0 without one.
uvec2 osgLabels_find(uint id)
{
    if (osgLabels_layout.w == 0u)
        return id < osgLabels_layout.z ? uvec2(id, osgLabels_texel(osgLabels_rows, id).r)
                                       : uvec2(~0u, 0u);
    uint h = id * 0x9E3779B1u;
    h = (h ^ h >> 15u) * 0x85EBCA77u;
    uint slot = h >> (32u - osgLabels_layout.z);
    for (uint i = 0u; i < osgLabels_layout.w; ++i)
    {
        uvec2 entry = osgLabels_texel(osgLabels_rows, slot).rg;
        if (entry.x == id)
            return uvec2(slot, entry.y);
        if (entry.x == 0u)
            break;
        slot = slot + 1u & (1u << osgLabels_layout.z) - 1u;
    }
    return uvec2(~0u, 0u);
}

osgLabels_Text osgLabels_textOf(uint id)
{
    uint row = osgLabels_find(id).y;
    uint offset = row >> 6u << osgLabels_layout.y;
    int length = int(row & 63u);
    if (length == 63)
    {
        length = int(osgLabels_bits(offset * osgLabels_layout.x, 10u)) + 1;
        offset += (9u + osgLabels_layout.x) / osgLabels_layout.x;
    }
    return osgLabels_Text(offset, length);
}

// 0 <= i < length.
uint osgLabels_code(osgLabels_Text text, int i)
{
    return osgLabels_bits((text.offset + uint(i)) * osgLabels_layout.x, osgLabels_layout.x);
}

// Of a text of at least OSGLABELS_SUMS letters in a proportional font, the advances of its first
// 16 * count letters, or of all where it has fewer: em. 16 * (count - 1) < length.
#define OSGLABELS_SUMS 32
float osgLabels_sumOf(osgLabels_Text text, int count)
{
    if (count <= 0)
        return 0.0;
    uint at = (text.offset + uint(text.length)) * osgLabels_layout.x + 32u * uint(count - 1);
    uint shift = at & 31u;
    uint bits = osgLabels_texel(osgLabels_texts, at >> 5u).r >> shift;
    if (shift > 0u)
        bits |= osgLabels_texel(osgLabels_texts, (at >> 5u) + 1u).r << (32u - shift);
    return uintBitsToFloat(bits);
}

uint osgLabels_styleOf(uint id)
{
    if (osgLabels_styleCount == 0u)
        return 0u;
    uint slot = osgLabels_find(id).x;
    return slot < osgLabels_styleCount ? osgLabels_texel(osgLabels_styles, slot).r : 0u;
}
