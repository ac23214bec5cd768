#version 120

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;
varying vec3 modelNormal;

void main()
{
    eyePosition = vec3(gl_ModelViewMatrix * gl_Vertex);
    eyeNormal = gl_NormalMatrix * gl_Normal;
    modelPosition = gl_Vertex.xyz;
    modelNormal = gl_Normal;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
