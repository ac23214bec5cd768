// The side of the volume at an edge (a, b) with two opposite vertices: the quad b, a, a', b'.

layout(lines_adjacency) in;
layout(triangle_strip, max_vertices = 4) out;

flat in int osgsv_index[];
in vec3 osgsv_position[];
in vec4 osgsv_extruded[];
flat out float osgsv_multiplicity;

void osgsv_emit(vec4 position, float multiplicity)
{
    osgsv_multiplicity = multiplicity;
    gl_Position = position;
    EmitVertex();
}

void main()
{
    // CasterMesh puts the edge first, then the opposite vertices.
    int sum = 0;
    for (int i = 2; i < 4; ++i)
        sum += osgsv_side(osgsv_position[0], osgsv_index[0], osgsv_position[1], osgsv_index[1],
                          osgsv_position[i], osgsv_index[i]);
    if (sum == 0)
        return;
    float multiplicity = float(sum) * osgsv_handedness;
    osgsv_emit(gl_in[1].gl_Position, multiplicity);
    osgsv_emit(gl_in[0].gl_Position, multiplicity);
    osgsv_emit(osgsv_extruded[1], multiplicity);
    osgsv_emit(osgsv_extruded[0], multiplicity);
    EndPrimitive();
}
