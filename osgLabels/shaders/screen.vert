// One triangle over the viewport.
void main()
{
    gl_Position = gl_Vertex;
}
