// An edge as a patch: its ends, then the opposite vertices of all triangles at it.

layout(vertices = 2) out;

flat in int osgsv_index[];
in vec3 osgsv_position[];
in vec4 osgsv_extruded[];
out vec4 osgsv_endOf[];
patch out float osgsv_edgeMultiplicity;

void main()
{
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    osgsv_endOf[gl_InvocationID] = osgsv_extruded[gl_InvocationID];
    if (gl_InvocationID != 0)
        return;
    int sum = 0;
    for (int i = 2; i < gl_PatchVerticesIn; ++i)
        sum += osgsv_side(osgsv_position[0], osgsv_index[0], osgsv_position[1], osgsv_index[1],
                          osgsv_position[i], osgsv_index[i]);
    osgsv_edgeMultiplicity = float(sum) * osgsv_handedness;
    // A level of 0 discards the patch; 1 makes one quad, which counts by its multiplicity.
    float level = sum == 0 ? 0.0 : 1.0;
    gl_TessLevelOuter[0] = level;
    gl_TessLevelOuter[1] = level;
    gl_TessLevelOuter[2] = level;
    gl_TessLevelOuter[3] = level;
    gl_TessLevelInner[0] = level;
    gl_TessLevelInner[1] = level;
}
