// The label of a surface that is drawn in the view: a blended or sorted one.

uniform int osgLabels_frame; // negative where rays are parallel
uniform vec3 osgLabels_frameValues[9];

vec4 osgLabels_direct(vec4 color, int index, vec2 texCoord, vec4 change)
{
    osgLabels_Surface surface;
    surface.parallel = osgLabels_frame < 0;
    surface.distance = surface.parallel ? (gl_FragCoord.z - gl_DepthRange.near) / gl_DepthRange.diff : 1.0 / gl_FragCoord.w;
    surface.dx = dFdx(surface.distance);
    surface.dy = dFdy(surface.distance);
    osgLabels_Object object = osgLabels_objectOf(uint(index));
    osgLabels_Text text = osgLabels_textOf(object.id);
    if (text.length == 0)
        return color;
    float width = osgLabels_width(text);
    osgLabels_Frame frame = osgLabels_Frame(
        osgLabels_frameValues[0], osgLabels_frameValues[1], osgLabels_frameValues[2],
        osgLabels_frameValues[3], osgLabels_frameValues[4], osgLabels_frameValues[5],
        osgLabels_frameValues[6], osgLabels_frameValues[7], osgLabels_frameValues[8]);
    osgLabels_Place at;
    if ((object.shape & 0xffu) == 10u)
        at = osgLabels_locateTextured(object, frame, surface, texCoord, change, width);
    else
        at = osgLabels_locate(object, frame, surface, width);
    if (!at.inside)
        return color;
    // No picture of the surface is there to choose ink by; the material's colour is the same for
    // the whole text.
    return osgLabels_over(color, text, at, osgLabels_styleOf(object.id),
                          gl_FrontMaterial.diffuse.rgb);
}
