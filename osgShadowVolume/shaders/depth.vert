// Depths of surfaces, as their own programs give them.
invariant gl_Position;

void main()
{
    gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;
    gl_Position = ftransform();
}
