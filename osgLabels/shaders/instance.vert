// Where a vertex of a unit mesh lies on the object of a PrimitiveBatch that is drawn. The twin of
// placePoint() in PrimitiveShape.cpp.

#ifndef OSGLABELS_OBJECT
#define OSGLABELS_OBJECT
layout(location = 6) in int osgLabels_object; // the first object of a draw
#endif
uniform usamplerBuffer osgLabels_records; // three texels an object, see ObjectRecord.h
uniform samplerBuffer osgLabels_colors;

vec3 osgLabels_unrotate(vec4 rotation, vec3 v)
{
    vec3 axis = -rotation.xyz;
    return v + 2.0 * cross(axis, cross(axis, v) + rotation.w * v);
}

void osgLabels_onTorus(vec3 size, inout vec3 position, inout vec3 normal)
{
    float angle = position.x * size.z;
    vec3 outward = vec3(cos(angle), sin(angle), 0.0), up = vec3(0.0, 0.0, 1.0);
    vec3 along = vec3(-outward.y, outward.x, 0.0);
    position = outward * (size.x + size.y * position.y) + up * (size.y * position.z);
    normal = along * normal.x + outward * normal.y + up * normal.z;
}

void osgLabels_onFrustum(vec3 size, inout vec3 position, inout vec3 normal)
{
    float radius = size.x + (size.y - size.x) * 0.5 * (position.z + 1.0);
    position = vec3(position.xy * radius, position.z * size.z);
    if (normal.z == 0.0)
        normal = vec3(normal.xy * 2.0 * size.z, size.x - size.y);
}

void osgmr_instance(inout vec4 vertex, inout vec3 normal, inout vec4 color)
{
    int object = osgLabels_object + gl_InstanceID;
    int record = 3 * object;
    vec4 rotation = uintBitsToFloat(texelFetch(osgLabels_records, record));
    uvec4 place = texelFetch(osgLabels_records, record + 1);
    vec3 size = uintBitsToFloat(texelFetch(osgLabels_records, record + 2).xyz);
    vec3 position = vertex.xyz;
    uint shape = place.w & 0xffu;
    if (shape == 7u)
        osgLabels_onTorus(size, position, normal);
    else if (shape == 5u)
        osgLabels_onFrustum(size, position, normal);
    else
    {
        float largest = max(max(size.x, size.y), size.z);
        vec3 s = largest > 0.0 ? size / largest : vec3(0.0);
        position *= size;
        normal *= s.yzx * s.zxy;
    }
    float scale = length(normal);
    normal = osgLabels_unrotate(rotation, scale > 0.0 ? normal / scale : vec3(0.0));
    vertex = vec4(osgLabels_unrotate(rotation, position) + uintBitsToFloat(place.xyz), 1.0);
    color = texelFetch(osgLabels_colors, object);
}
