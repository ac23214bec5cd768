// A map label: plate, outline, letters and leader line, as far as nothing stands before it. Colours have
// their opacity in them. Needs coverage.glsl and occlusion.glsl.

flat in vec4 osgLabels_text;
flat in vec4 osgLabels_anchor;
flat in uvec4 osgLabels_keys;
#ifdef OSGLABELS_STATES
flat in int osgLabels_state; // of the whole label
#endif

uniform vec4 osgLabels_looks[48];    // by style: ink, plate, outline (width in em)
uniform vec2 osgLabels_pad;
uniform vec4 osgLabels_color;        // of what is recoloured
uniform float osgLabels_fade;

layout(location = 0) out vec4 osgmr_out0;

void osgLabels_put(inout vec4 color, vec4 over, float share)
{
    float alpha = over.a * share;
    color = vec4(over.rgb * alpha, alpha) + color * (1.0 - alpha);
}

// Share of the pixel that a box with round corners covers.
float osgLabels_plateAt(vec2 at, vec2 size, float radius)
{
    vec2 q = abs(at) - size + radius;
    return clamp(0.5 - (length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - radius), 0.0, 1.0);
}

void main()
{
#ifdef OSGLABELS_STATES
    int action = osgLabels_state;
#else
    int action = osgLabels_actionAt(ivec2(gl_FragCoord.xy), osgLabels_anchor.z, osgLabels_keys.yz);
#endif
    if (action == osgLabels_Hide)
        discard;
    float em = osgLabels_text.z;
    vec2 at = gl_FragCoord.xy - osgLabels_text.xy;
    vec2 size = (vec2(0.5 * osgLabels_text.w, 0.5) + osgLabels_pad) * em;
    vec4 ink = osgLabels_looks[3u * osgLabels_keys.w];
    vec4 plate = osgLabels_looks[3u * osgLabels_keys.w + 1u];
    vec4 outline = osgLabels_looks[3u * osgLabels_keys.w + 2u];
    vec2 place = at / em + vec2(0.5 * osgLabels_text.w, 0.5);
    vec2 cover = osgLabels_inkAndOutline(osgLabels_textOf(osgLabels_keys.x), place, mat2(1.0 / em));
    vec4 color = vec4(0.0);
    float bottom = osgLabels_text.y - size.y;
    float line = clamp(1.25 - abs(gl_FragCoord.x - osgLabels_anchor.x), 0.0, 1.0) *
                 clamp(bottom - gl_FragCoord.y + 0.5, 0.0, 1.0) *
                 clamp(gl_FragCoord.y - osgLabels_anchor.y + 0.5, 0.0, 1.0);
    if (action == osgLabels_Recolor)
        ink = vec4(osgLabels_color.rgb, ink.a);
    osgLabels_put(color, vec4(ink.rgb, 1.0), line);
    if (action != osgLabels_Outline)
    {
        osgLabels_put(color, plate, osgLabels_plateAt(at, size, min(0.25 * em, size.y)));
        osgLabels_put(color, vec4(outline.rgb, 1.0), outline.a > 0.0 ? max(cover.x, cover.y) : 0.0);
        osgLabels_put(color, ink, cover.x);
    }
#ifdef OSGLABELS_OUTLINE
    else
        osgLabels_put(color, ink, max(cover.y - cover.x, 0.0));
#else
    else // where a pixel is covered in part
        osgLabels_put(color, ink, 4.0 * cover.x * (1.0 - cover.x));
#endif
    float opacity = action == osgLabels_Fade ? osgLabels_fade : 1.0;
    osgmr_out0 = color * opacity;
    if (osgmr_out0.a == 0.0)
        discard;
}
