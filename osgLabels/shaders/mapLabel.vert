// A quad around a map label and its leader line. Needs labelTable.glsl.

uniform osgLabels_Buffer osgLabels_mapLabels; // three texels each, then the numbers of those that are drawn
uniform int osgLabels_orderAt;
uniform vec4 osgLabels_viewport;              // x, y, 2 / width, 2 / height
uniform vec2 osgLabels_pad;                   // em between text and the edge of its plate

flat out vec4 osgLabels_text;    // middle of the text, em, its width in em
flat out vec4 osgLabels_anchor;  // pixels, distance
flat out uvec4 osgLabels_keys;   // text, own numbers from, to, style
#ifdef OSGLABELS_STATES
uniform sampler2D osgLabels_states;
flat out int osgLabels_state;
#endif

void main()
{
    uvec4 four = osgLabels_texel(osgLabels_mapLabels, uint(osgLabels_orderAt + (gl_InstanceID >> 2)));
    int label = int(four[gl_InstanceID & 3]);
    uint at = 3u * uint(label);
    osgLabels_text = uintBitsToFloat(osgLabels_texel(osgLabels_mapLabels, at));
    osgLabels_anchor = uintBitsToFloat(osgLabels_texel(osgLabels_mapLabels, at + 1u));
    osgLabels_keys = osgLabels_texel(osgLabels_mapLabels, at + 2u);
    osgLabels_keys.w &= 0x3fu;
#ifdef OSGLABELS_STATES
    int row = textureSize(osgLabels_states, 0).x;
    osgLabels_state = int(texelFetch(osgLabels_states, ivec2(label % row, label / row), 0).r + 0.5);
#endif
    vec2 size = (vec2(0.5 * osgLabels_text.w, 0.5) + osgLabels_pad) * osgLabels_text.z + 1.0;
    vec2 low = osgLabels_text.xy - size, high = osgLabels_text.xy + size;
    low.y = min(low.y, osgLabels_anchor.y - 1.0);
    vec2 pixel = mix(low, high, gl_Vertex.xy);
    gl_Position = vec4((pixel - osgLabels_viewport.xy) * osgLabels_viewport.zw - 1.0, 0.0, 1.0);
}
