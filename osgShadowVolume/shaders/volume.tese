// The side of the volume at an edge (a, b): the quad b, a, a', b'.

layout(quads, equal_spacing, ccw) in;

in vec4 osgsv_endOf[];
patch in float osgsv_edgeMultiplicity;
flat out float osgsv_multiplicity;

void main()
{
    osgsv_multiplicity = osgsv_edgeMultiplicity;
    bool isA = gl_TessCoord.x > 0.5;
    if (gl_TessCoord.y > 0.5)
        gl_Position = isA ? osgsv_endOf[0] : osgsv_endOf[1];
    else
        gl_Position = isA ? gl_in[0].gl_Position : gl_in[1].gl_Position;
}
