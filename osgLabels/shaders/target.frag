// The first pass of an opaque surface: which object is here, in which frame of coordinates, and how
// far away; of the distance also how it changes by a pixel. Where the text is follows from these in
// the second pass, once a pixel instead of once a fragment. See locate.glsl. Frames with parallel rays
// have negative numbers.

layout(location = 1) out uvec4 osgLabels_outSurface;

// The upper half of a float, rounded: 8 bits of precision, which a change by a pixel needs no more of.
uint osgLabels_short(float value)
{
    return (floatBitsToUint(value) + 0x8000u) >> 16;
}

void osgLabels_writeSurface(int object, int frame)
{
    float distance = frame < 0 ? (gl_FragCoord.z - gl_DepthRange.near) / gl_DepthRange.diff : 1.0 / gl_FragCoord.w;
    uint change = osgLabels_short(dFdx(distance)) | osgLabels_short(dFdy(distance)) << 16;
    osgLabels_outSurface = uvec4(uint(object), uint(frame), floatBitsToUint(distance), change);
}
