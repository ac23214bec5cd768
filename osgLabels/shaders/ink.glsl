// What a label does to the colour of a surface.

// By style: ink (alpha 0: black or white, whichever shows), plate (alpha < 0: where the ink needs
// one), outline (width in em).
uniform vec4 osgLabels_looks[48];

// Relative luminance of an sRGB colour (Web Content Accessibility Guidelines 2.1).
float osgLabels_luminance(vec3 color)
{
    vec3 c = clamp(color, 0.0, 1.0);
    vec3 linear = mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThan(c, vec3(0.04045)));
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

// At this luminance black and white have the same contrast, 4.58 to 1: one of them has more on any
// other colour.
vec3 osgLabels_opposite(float luminance)
{
    return vec3(luminance > 0.1791 ? 0.0 : 1.0);
}

vec4 osgLabels_over(vec4 surface, osgLabels_Text text, vec2 place, mat2 footprint, uint style)
{
    vec4 ink = osgLabels_looks[3u * style];
    vec4 plate = osgLabels_looks[3u * style + 1u];
    vec4 outline = osgLabels_looks[3u * style + 2u];
    vec3 under = surface.rgb;
    float covered = 0.0;
    if (plate.a > 0.0)
        covered = plate.a;
    else if (plate.a < 0.0 && ink.a > 0.0)
    {
        vec2 light = vec2(osgLabels_luminance(under), osgLabels_luminance(ink.rgb)) + 0.05;
        plate.rgb = osgLabels_opposite(light.y - 0.05);
        covered = max(light.x, light.y) < 4.5 * min(light.x, light.y) ? 1.0 : 0.0;
    }
    under = mix(under, plate.rgb, covered);
    if (ink.a == 0.0)
        ink = vec4(osgLabels_opposite(osgLabels_luminance(under)), 1.0);
    vec2 cover;
    if (outline.a > 0.0)
        cover = osgLabels_inkAndOutline(text, place, footprint);
    else
        cover = vec2(osgLabels_coverage(text, place, footprint), 0.0);
    vec3 color = mix(under, outline.rgb, max(cover.y, cover.x) * float(outline.a > 0.0));
    color = mix(color, ink.rgb, cover.x * ink.a);
    float alpha = max(max(covered, cover.x * ink.a), cover.y);
    return vec4(color, mix(surface.a, 1.0, alpha));
}
