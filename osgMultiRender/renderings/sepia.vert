#version 120

varying vec2 place;

void main()
{
    place = vec2(gl_TextureMatrix[0] * gl_MultiTexCoord0);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
