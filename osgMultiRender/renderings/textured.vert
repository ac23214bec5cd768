#version 120

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec4 color;
varying vec2 place;

void main()
{
    eyePosition = vec3(gl_ModelViewMatrix * gl_Vertex);
    eyeNormal = gl_NormalMatrix * gl_Normal;
    color = gl_Color;
    place = vec2(gl_TextureMatrix[0] * gl_MultiTexCoord0);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
