float osgLabels_width(osgLabels_Text text) { return 0.5 * float(text.length); }
float osgLabels_coverage(osgLabels_Text text, vec2 place, mat2 footprint)
{
    int i = clamp(int(place.x * 2.0), 0, text.length - 1);
    uint code = osgLabels_code(text, i);
    vec2 cell = vec2(fract(place.x * 2.0), place.y);
    ivec2 bit = ivec2(cell * vec2(4.0, 4.0));
    bool frame = bit.x < 3 && bit.y > 0 && bit.y < 3;
    return frame && ((code >> uint(bit.x + 3 * (bit.y - 1))) & 1u) != 0u ? 1.0 : 0.0;
}
vec2 osgLabels_inkAndOutline(osgLabels_Text text, vec2 place, mat2 footprint)
{
    return vec2(osgLabels_coverage(text, place, footprint), 0.0);
}
