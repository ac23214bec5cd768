// For comparison: a triangle is judged from each of its three corners and left out where these do
// not agree. All volumes are closed, and some shadows are missing.

uniform vec4 osgsv_localLight;  // in the mesh's frame: MeshLight
uniform vec3 osgsv_lightRest;
uniform float osgsv_meshScale;  // EdgeMesh::scale
uniform float osgsv_handedness; // sign of the modelview's determinant

int osgsv_facingFrom(vec3 a, vec3 b, vec3 c)
{
    precise vec3 u = (c - a) * osgsv_meshScale;
    precise vec3 v = (osgsv_localLight.xyz - a * osgsv_localLight.w) + osgsv_lightRest;
    precise vec3 n = vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    precise vec3 e = (b - a) * osgsv_meshScale;
    precise float side = n.x * e.x + n.y * e.y + n.z * e.z;
    return side > 0.0 ? 1 : side < 0.0 ? -1 : 0;
}

// a, b, c in ascending order of their indices.
int osgsv_facing(vec3 a, vec3 b, vec3 c)
{
    int facing = osgsv_facingFrom(a, b, c);
    return facing == osgsv_facingFrom(b, c, a) && facing == osgsv_facingFrom(c, a, b) ? facing : 0;
}

// What the triangle with the opposite vertex o adds to the edge (a, b), whose indices ascend.
int osgsv_side(vec3 a, int aIndex, vec3 b, int bIndex, vec3 o, int oIndex)
{
    if (oIndex == aIndex || oIndex == bIndex)
        return 0;
    return oIndex < aIndex ? osgsv_facing(o, a, b)
           : oIndex > bIndex ? osgsv_facing(a, b, o) : -osgsv_facing(a, o, b);
}
