// One point a map label, at the place of its state. Needs labelTable.glsl.

uniform osgLabels_Buffer osgLabels_mapLabels; // three texels each
uniform vec2 osgLabels_stateSize;

flat out vec4 osgLabels_text;
flat out vec4 osgLabels_anchor;
flat out uvec4 osgLabels_keys;

void main()
{
    uint at = 3u * uint(gl_InstanceID);
    osgLabels_text = uintBitsToFloat(osgLabels_texel(osgLabels_mapLabels, at));
    osgLabels_anchor = uintBitsToFloat(osgLabels_texel(osgLabels_mapLabels, at + 1u));
    osgLabels_keys = osgLabels_texel(osgLabels_mapLabels, at + 2u);
    int row = int(osgLabels_stateSize.x);
    vec2 texel = vec2(gl_InstanceID % row, gl_InstanceID / row) + 0.5;
    gl_Position = vec4(2.0 * texel / osgLabels_stateSize - 1.0, 0.0, 1.0);
}
