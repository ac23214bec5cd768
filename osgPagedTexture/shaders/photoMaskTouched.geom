#version 330
// Every pixel that a triangle touches: its box is drawn, and the fragment asks for the three edges.
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;
uniform vec2 osgPagedTexture_pieceSize;
flat in vec2 corner[];
flat out vec2 triangleCorners[3];

void main()
{
    // Half a pixel, and what coordinates are rounded by.
    const float Reach = 0.5 + 1.0 / 128.0;
    vec2 low = min(corner[0], min(corner[1], corner[2])) - Reach;
    vec2 high = max(corner[0], max(corner[1], corner[2])) + Reach;
    for (int i = 0; i < 4; ++i)
    {
        vec2 place = vec2(i % 2 == 0 ? low.x : high.x, i / 2 == 0 ? low.y : high.y);
        triangleCorners = vec2[3](corner[0], corner[1], corner[2]);
        gl_Position = vec4(place * (2.0 / osgPagedTexture_pieceSize), 0.0, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
