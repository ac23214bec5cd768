// Where on its label a pixel lies, from gl_FragCoord and the surface's distance: so any vertex stage
// will do, and what is near the eye is exact, however long the object is.

uniform vec4 osgLabels_viewport; // x, y, 2 / width, 2 / height
uniform vec2 osgLabels_line;     // height of text as a share of the room, least gap in em
uniform osgLabels_Buffer osgLabels_objects;

// Of a matrix from local to clip coordinates, its inverse as the fragment needs it.
struct osgLabels_Frame
{
    vec3 x, y, z;   // what ndc.x w, ndc.y w, and w or ndc.z weigh, in local coordinates
    vec3 offset;    // what is added; the sum is relative to the eye
    vec3 eye;
    vec3 right, up; // of the screen
    vec3 back;      // to the viewer, where rays are parallel
    vec3 world;     // the world's up
};

// What is here: 1 / gl_FragCoord.w, or depth from 0 to 1 where rays are parallel, and its changes.
struct osgLabels_Surface
{
    bool parallel;
    float distance, dx, dy;
};

osgLabels_Object osgLabels_objectOf(uint index)
{
    uvec4 a = osgLabels_texel(osgLabels_objects, 3u * index);
    uvec4 b = osgLabels_texel(osgLabels_objects, 3u * index + 1u);
    uvec4 c = osgLabels_texel(osgLabels_objects, 3u * index + 2u);
    return osgLabels_Object(uintBitsToFloat(a), uintBitsToFloat(b.xyz), b.w,
                            uintBitsToFloat(c.xyz), c.w);
}

// Along texture coordinates that are not flat in the mesh.
bool osgLabels_isBent(osgLabels_Object object)
{
    return (object.shape & 0x2ffu) == 0x20au;
}

// Relative to the eye.
vec3 osgLabels_pointAt(osgLabels_Frame frame, bool parallel, vec2 ndc, float distance)
{
    vec3 clip = parallel ? vec3(ndc, 2.0 * distance - 1.0) : vec3(ndc * distance, distance);
    return frame.x * clip.x + frame.y * clip.y + frame.z * clip.z + frame.offset;
}

// The pixel of a point relative to the eye; one beside the view for what lies behind the eye.
vec2 osgLabels_pixelAt(osgLabels_Frame frame, bool parallel, vec3 point)
{
    vec3 yz = cross(frame.y, frame.z);
    vec3 clip = vec3(dot(yz, point - frame.offset),
                     dot(cross(frame.z, frame.x), point - frame.offset),
                     dot(cross(frame.x, frame.y), point - frame.offset)) / dot(frame.x, yz);
    vec2 ndc = parallel ? clip.xy : clip.z > 0.0 ? clip.xy / clip.z : vec2(-2.0);
    return (clamp(ndc, -2.0, 2.0) + 1.0) / osgLabels_viewport.zw + osgLabels_viewport.xy;
}

osgLabels_Place osgLabels_locate(osgLabels_Object object, osgLabels_Frame frame,
                                 osgLabels_Surface surface, float width)
{
    vec2 pixel = osgLabels_viewport.zw;
    vec2 ndc = (gl_FragCoord.xy - osgLabels_viewport.xy) * pixel - 1.0;
    bool parallel = surface.parallel;
    vec3 position = osgLabels_pointAt(frame, parallel, ndc, surface.distance);
    vec3 dx = osgLabels_pointAt(frame, parallel, ndc + vec2(pixel.x, 0.0),
                                surface.distance + surface.dx) - position;
    vec3 dy = osgLabels_pointAt(frame, parallel, ndc + vec2(0.0, pixel.y),
                                surface.distance + surface.dy) - position;
    osgLabels_View view;
    view.base = frame.eye - object.origin;
    view.eye = parallel ? vec4(frame.back, 0.0) : vec4(view.base, 1.0);
    view.screenRight = frame.right;
    view.screenUp = frame.up;
    view.up = frame.world;
    view.height = osgLabels_line.x;
    view.gap = osgLabels_line.y;
    osgLabels_Place at = osgLabels_placeOn(object, position, dx, dy, view, width);
    for (int i = 0; i < 3; ++i)
        at.onLine[i].xy = osgLabels_pixelAt(frame, parallel, at.onLine[i]);
    return at;
}

// A label that follows texture coordinates. Where these are not flat in the mesh its ink goes by
// places around the mesh's middle: the same for all pixels of the object.
osgLabels_Place osgLabels_locateTextured(osgLabels_Object object, osgLabels_Frame frame,
                                         osgLabels_Surface surface, vec2 at, vec4 change,
                                         float width)
{
    osgLabels_View view;
    view.base = vec3(0.0);
    view.eye = vec4(0.0);
    view.screenRight = vec3(0.0);
    view.screenUp = vec3(0.0);
    view.up = vec3(0.0);
    view.height = osgLabels_line.x;
    view.gap = osgLabels_line.y;
    osgLabels_Place result =
        osgLabels_placeOn(object, vec3(at - object.origin.xy, 0.0), vec3(change.xy, 0.0),
                          vec3(change.zw, 0.0), view, width);
    if (osgLabels_isBent(object))
    {
        vec3 middle = vec3(object.rotation.zw, object.origin.z) - frame.eye;
        for (int i = 0; i < 3; ++i)
            result.onLine[i].xy = osgLabels_pixelAt(
                frame, surface.parallel, middle + (float(i) - 1.0) * object.size.z * frame.right);
        return result;
    }
    // As if the surface were flat: only the ink's colour depends on it. In perspective what lies
    // farther away by a share is nearer on the screen by that.
    mat2 toPixels = inverse(result.footprint);
    vec2 farther = vec2(surface.dx, surface.dy) / (surface.parallel ? 1e30 : surface.distance);
    for (int i = 0; i < 3; ++i)
    {
        vec2 off = toPixels * (vec2((float(i) + 0.5) * 0.3333333 * width, 0.5) - result.place);
        result.onLine[i].xy = gl_FragCoord.xy + off / max(1.0 + dot(farther, off), 1e-3);
    }
    return result;
}
