#version 120

// Gouraud shading: the material under all lights, computed at the vertices.

varying vec4 litColor;

void main()
{
    gl_FragColor = litColor;
}
