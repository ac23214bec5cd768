#version 120

// Gouraud shading: the material under light 0, computed at the vertices.

varying vec4 litColor;

void main()
{
    gl_FragColor = litColor;
}
