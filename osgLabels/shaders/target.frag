// Says where on its label a fragment lies, from gl_FragCoord alone: so any vertex stage will do, and
// what is near the eye is exact, however long the object is.
// osgLabels_index is that of the object's record.

uniform vec4 osgLabels_viewport; // x, y, 2 / width, 2 / height
// Local coordinates: what (ndc.x w, ndc.y w, w or ndc.z) weigh and what is added, relative to the
// eye; the eye; the view's right, up and back; the world's up; ndc.z at depth 0 and its growth where
// rays are parallel, else 0.
uniform vec3 osgLabels_frame[10];
uniform vec2 osgLabels_layoutOfText; // height as a share of the room, least gap in em
uniform OSGLABELS_RECORDS osgLabels_records;

osgLabels_Object osgLabels_objectOf(int index)
{
    uvec4 a = OSGLABELS_RECORD(3u * uint(index));
    uvec4 b = OSGLABELS_RECORD(3u * uint(index) + 1u);
    uvec4 c = OSGLABELS_RECORD(3u * uint(index) + 2u);
    return osgLabels_Object(uintBitsToFloat(a), uintBitsToFloat(b.xyz), b.w,
                            uintBitsToFloat(c.xyz), c.w);
}

// The identifier at this fragment, and where on its text; place.x < 0 off the text.
uint osgLabels_locate(out osgLabels_Text text, out vec2 place, out mat2 footprint)
{
    float w = 1.0 / gl_FragCoord.w;
    vec2 ndc = (gl_FragCoord.xy - osgLabels_viewport.xy) * osgLabels_viewport.zw - 1.0;
    vec2 depth = osgLabels_frame[9].xy;
    bool parallel = depth.y != 0.0;
    vec3 clip = vec3(ndc * w, parallel ? depth.x + depth.y * gl_FragCoord.z : w);
    vec3 position = osgLabels_frame[0] * clip.x + osgLabels_frame[1] * clip.y +
                    osgLabels_frame[2] * clip.z + osgLabels_frame[3];
    vec3 dx = dFdx(position);
    vec3 dy = dFdy(position);
#ifdef OSGLABELS_TEXCOORD
    vec3 textureDx = vec3(dFdx(osgLabels_texCoord), 0.0);
    vec3 textureDy = vec3(dFdy(osgLabels_texCoord), 0.0);
#endif

    place = vec2(-1.0);
    footprint = mat2(0.0);
    text = osgLabels_Text(0u, 0);
    osgLabels_Object object = osgLabels_objectOf(osgLabels_index);
    if (object.id == 0u)
        return 0u;
    text = osgLabels_textOf(object.id);
    if (text.length == 0)
        return object.id;
    if ((object.shape & 0xffu) == 10u)
    {
#ifdef OSGLABELS_TEXCOORD
        position = vec3(osgLabels_texCoord - object.origin.xy, 0.0);
        dx = textureDx;
        dy = textureDy;
#else
        return object.id; // the model's own program hides them
#endif
    }
    osgLabels_View view;
    view.base = osgLabels_frame[4] - object.origin;
    view.eye = parallel ? vec4(osgLabels_frame[7], 0.0) : vec4(view.base, 1.0);
    view.screenRight = osgLabels_frame[5];
    view.screenUp = osgLabels_frame[6];
    view.up = osgLabels_frame[8];
    view.height = osgLabels_layoutOfText.x;
    view.gap = osgLabels_layoutOfText.y;
    osgLabels_Place found =
        osgLabels_placeOn(object, position, dx, dy, view, osgLabels_width(text));
    if (found.inside)
    {
        place = found.place;
        footprint = found.footprint;
    }
    return object.id;
}
