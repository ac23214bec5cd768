// The ends of the volume of a triangle: itself and its extrusion, where that is not a point.

layout(triangles) in;
layout(triangle_strip, max_vertices = 6) out;

flat in int osgsv_index[];
in vec3 osgsv_position[];
in vec4 osgsv_extruded[];
flat out float osgsv_multiplicity;

uniform float osgsv_end; // w of extrusions: 0 at infinity

void osgsv_emit(vec4 position, float multiplicity)
{
    osgsv_multiplicity = multiplicity;
    gl_Position = position;
    EmitVertex();
}

void main()
{
    int facing = osgsv_facing(osgsv_position[0], osgsv_position[1], osgsv_position[2]);
    if (facing == 0)
        return;
    float multiplicity = float(facing) * osgsv_handedness;
    for (int i = 0; i < 3; ++i)
        osgsv_emit(gl_in[i].gl_Position, multiplicity);
    EndPrimitive();
    // All extrusions at infinity of a light at infinity are the same point.
    if (osgsv_localLight.w == 0.0 && osgsv_end == 0.0)
        return;
    for (int i = 2; i >= 0; --i)
        osgsv_emit(osgsv_extruded[i], multiplicity);
    EndPrimitive();
}
