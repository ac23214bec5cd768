#version 330
uniform vec2 osgPagedTexture_pieceSize;
flat in vec2 triangleCorners[3];
out vec4 used;

void main()
{
    // A pixel and a triangle are convex: they are apart where a side of either lies between them.
    // The sides of the pixel are those of the box that is drawn.
    const float Reach = 0.5 + 1.0 / 256.0;
    vec2 place = gl_FragCoord.xy - 0.5 * osgPagedTexture_pieceSize;
    vec2 a = triangleCorners[1] - triangleCorners[0];
    vec2 b = triangleCorners[2] - triangleCorners[0];
    float turn = a.x * b.y - a.y * b.x;
    for (int i = 0; i < 3; ++i)
    {
        vec2 from = triangleCorners[i];
        vec2 along = triangleCorners[(i + 1) % 3] - from;
        vec2 to = place - from;
        float side = along.x * to.y - along.y * to.x;
        float reach = Reach * (abs(along.x) + abs(along.y));
        // Without an area there is no inside, and all three sides are one line.
        float outside = turn > 0.0 ? -side : turn < 0.0 ? side : abs(side);
        if (outside > reach)
            discard;
    }
    used = vec4(1.0);
}
