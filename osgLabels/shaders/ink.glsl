// What a label does to the colour of a surface.

// By style: ink (alpha 0: black or white, whichever shows), plate (alpha < 0: where the ink needs
// one), outline (width in em).
uniform vec4 osgLabels_looks[48];

const vec3 osgLabels_Weights = vec3(0.2126, 0.7152, 0.0722);

// Of an sRGB colour.
vec3 osgLabels_linear(vec3 color)
{
    vec3 c = clamp(color, 0.0, 1.0);
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThan(c, vec3(0.04045)));
}

// Relative luminance of an sRGB colour (Web Content Accessibility Guidelines 2.1).
float osgLabels_luminance(vec3 color)
{
    return dot(osgLabels_linear(color), osgLabels_Weights);
}

// At this luminance black and white have the same contrast, 4.58 to 1: one of them has more on any
// other colour.
vec3 osgLabels_opposite(float luminance)
{
    return vec3(luminance > 0.1791 ? 0.0 : 1.0);
}

// A surface's colour under black (0) or white (1) ink: no farther from its own than 4.55 to 1 takes,
// so that no edge shows where that begins. The reserve is for the rounding to 8 bits.
vec3 osgLabels_apart(vec3 color, float ink)
{
    vec3 c = osgLabels_linear(color);
    float luminance = dot(c, osgLabels_Weights);
    float least = 4.55 * 0.05 - 0.05, most = 1.05 / 4.55 - 0.05;
    if (ink > 0.5 ? luminance <= most : luminance >= least)
        return color;
    c = ink > 0.5 ? c * (most / luminance)
                  : mix(c, vec3(1.0), (least - luminance) / (1.0 - luminance));
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}

// `seen`: the surface's colour as ink is chosen by it, one for the whole text.
vec4 osgLabels_over(vec4 surface, osgLabels_Text text, osgLabels_Place at, uint style, vec3 seen)
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
    {
        ink = vec4(osgLabels_opposite(osgLabels_luminance(mix(seen, plate.rgb, covered))), 1.0);
        if (plate.a != 0.0)
            under = osgLabels_apart(under, ink.r);
    }
    vec2 cover;
    if (outline.a > 0.0)
        cover = osgLabels_inkAndOutline(text, at.place, at.footprint);
    else
        cover = vec2(osgLabels_coverage(text, at.place, at.footprint), 0.0);
    vec3 color = mix(under, outline.rgb, max(cover.y, cover.x) * float(outline.a > 0.0));
    color = mix(color, ink.rgb, cover.x * ink.a);
    float alpha = max(max(covered, cover.x * ink.a), cover.y);
    return vec4(color, mix(surface.a, 1.0, alpha));
}
