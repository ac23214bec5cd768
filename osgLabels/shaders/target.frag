// Says where on its label a fragment lies, from gl_FragCoord alone: so any vertex stage will do, and
// what is near the eye is exact, however long the object is.
//
// OSGLABELS_OBJECT is the index of the object's record. osgLabels_frame: columns of the matrix from
// (ndc.x w, ndc.y w, w or ndc.z w) to local coordinates relative to the eye, what is added, the eye
// in local coordinates, then right, up and back of the view in local coordinates.

uniform vec4 osgLabels_viewport;   // x, y, 2 / width, 2 / height
uniform vec2 osgLabels_depth;      // ndc.z of depth 0, its growth; 0, 0 in perspective
uniform vec3 osgLabels_frame[8];
uniform usamplerBuffer osgLabels_objects;

osgLabels_Object osgLabels_objectOf(int index)
{
    uvec4 a = texelFetch(osgLabels_objects, 3 * index);
    uvec4 b = texelFetch(osgLabels_objects, 3 * index + 1);
    uvec4 c = texelFetch(osgLabels_objects, 3 * index + 2);
    return osgLabels_Object(uintBitsToFloat(a), uintBitsToFloat(b.xyz), b.w,
                            uintBitsToFloat(c.xyz), c.w);
}

// The identifier at this fragment, and where on its text; place.x < 0 off the text.
uint osgLabels_find(out osgLabels_Text text, out vec2 place, out mat2 footprint)
{
    float w = 1.0 / gl_FragCoord.w;
    vec2 ndc = (gl_FragCoord.xy - osgLabels_viewport.xy) * osgLabels_viewport.zw - 1.0;
    bool parallel = osgLabels_depth.y != 0.0;
    vec3 clip =
        vec3(ndc * w, parallel ? osgLabels_depth.x + osgLabels_depth.y * gl_FragCoord.z : w);
    vec3 position = osgLabels_frame[0] * clip.x + osgLabels_frame[1] * clip.y +
                    osgLabels_frame[2] * clip.z + osgLabels_frame[3];
    vec3 dx = dFdx(position);
    vec3 dy = dFdy(position);
    vec3 toEye = parallel ? osgLabels_frame[7] : -position;

    place = vec2(-1.0);
    footprint = mat2(0.0);
    text = osgLabels_Text(0u, 0);
    osgLabels_Object object = osgLabels_objectOf(OSGLABELS_OBJECT);
    if (object.id == 0u)
        return 0u;
    text = osgLabels_textOf(object.id);
    if (text.length == 0)
        return object.id;
    osgLabels_Place found =
        osgLabels_placeOn(object, position + (osgLabels_frame[4] - object.origin), dx, dy, toEye,
                          osgLabels_frame[6], osgLabels_frame[5], osgLabels_width(text));
    if (found.inside)
    {
        place = found.place;
        footprint = found.footprint;
    }
    return object.id;
}
