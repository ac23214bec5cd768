// The second pass: finds each pixel's place on its label, and puts the labelled picture into the view.
// OSGLABELS_SAMPLES: of the targets.

#if OSGLABELS_SAMPLES > 1
#define osgLabels_Target2D sampler2DMS
uniform usampler2DMS osgLabels_surfaces;
uniform int osgLabels_sample;
#else
#define osgLabels_Target2D sampler2D
uniform usampler2D osgLabels_surfaces;
const int osgLabels_sample = 0;
#endif
uniform osgLabels_Target2D osgLabels_color, osgLabels_depths;
#ifdef OSGLABELS_TEXTURED
uniform osgLabels_Target2D osgLabels_texCoords, osgLabels_changes;
#endif
uniform osgLabels_Buffer osgLabels_frames; // seven texels each
uniform int osgLabels_flippedHeight;    // where rows count from the top, else 0

layout(location = 0) out vec4 osgmr_out0;

osgLabels_Frame osgLabels_frameOf(int number)
{
    vec4 t[7];
    uint at = 7u * uint(number < 0 ? -1 - number : number);
    for (uint i = 0u; i < 7u; ++i)
        t[i] = uintBitsToFloat(osgLabels_texel(osgLabels_frames, at + i));
    return osgLabels_Frame(t[0].xyz, vec3(t[0].w, t[1].xy), vec3(t[1].zw, t[2].x), t[2].yzw,
                           t[3].xyz, vec3(t[3].w, t[4].xy), vec3(t[4].zw, t[5].x), t[5].yzw,
                           t[6].xyz);
}

osgLabels_Place osgLabels_placeOf(osgLabels_Object object, uvec4 surface, ivec2 p, float width)
{
    osgLabels_Surface at;
    at.parallel = int(surface.y) < 0;
    at.distance = uintBitsToFloat(surface.z);
    at.dx = uintBitsToFloat(surface.w << 16);
    at.dy = uintBitsToFloat(surface.w & 0xffff0000u);
#ifdef OSGLABELS_TEXTURED
    if ((object.shape & 0xffu) == 10u)
        return osgLabels_locateTextured(
            object, osgLabels_frameOf(int(surface.y)), at, texelFetch(osgLabels_texCoords, p, osgLabels_sample).xy,
            texelFetch(osgLabels_changes, p, osgLabels_sample), width);
#endif
    return osgLabels_locate(object, osgLabels_frameOf(int(surface.y)), at, width);
}

ivec2 osgLabels_texelAt(vec2 pixel)
{
    ivec2 p = ivec2(pixel);
    if (osgLabels_flippedHeight > 0)
        p.y = osgLabels_flippedHeight - 1 - p.y;
    return p;
}

// The mean colour of the surface at three places along a text's line, as far as they are in view.
// Where none is, of the first of others that is: between them and, as something long may lie along
// the line, over and under it. `other` where all of these are hidden. But for that, it is the same for
// all pixels of a text; it is never the colour of what hides it.
vec3 osgLabels_seen(osgLabels_Place at, uint record, float width, vec3 other)
{
    vec2 low = osgLabels_viewport.xy, high = low + 2.0 / osgLabels_viewport.zw - 1.0;
    vec2 middle = at.onLine[1].xy;
    vec2 along = 0.5 * (at.onLine[2].xy - at.onLine[0].xy); // a third of the text
    vec2 over = vec2(-along.y, along.x) * (1.2 / max(width, 1.2)); // 0.4 em
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 3 || (i < 3 + 21 && sum.a == 0.0); ++i)
    {
        int n = max(i - 3, 0);
        vec2 off = float(n % 7 - 3) * 0.46 * along + float((n / 7 + 1) % 3 - 1) * over;
        vec2 pixel = i < 3 ? at.onLine[i].xy : middle + off;
        ivec2 p = osgLabels_texelAt(clamp(pixel, low, high));
        bool isOwn = texelFetch(osgLabels_surfaces, p, 0).x == record;
        sum += float(isOwn) * vec4(texelFetch(osgLabels_color, p, 0).rgb, 1.0);
    }
    return sum.a > 0.0 ? sum.rgb / sum.a : other;
}

void main()
{
    ivec2 p = osgLabels_texelAt(gl_FragCoord.xy);
    uvec4 surface = texelFetch(osgLabels_surfaces, p, osgLabels_sample);
    if (surface.x == 0xffffffffu) // nothing is drawn here
        discard;
    gl_FragDepth = texelFetch(osgLabels_depths, p, osgLabels_sample).r;
    vec4 color = texelFetch(osgLabels_color, p, osgLabels_sample);
    if (surface.x != 0u)
    {
        osgLabels_Object object = osgLabels_objectOf(surface.x);
        osgLabels_Text text = osgLabels_textOf(object.id);
        if (text.length > 0)
        {
            float width = osgLabels_width(text);
            osgLabels_Place at = osgLabels_placeOf(object, surface, p, width);
            if (at.inside)
                color = osgLabels_over(color, text, at, osgLabels_styleOf(object.id),
                                       osgLabels_seen(at, surface.x, width,
                                                      osgLabels_isBent(object) ? vec3(1.0) : color.rgb));
        }
    }
    osgmr_out0 = color;
}
