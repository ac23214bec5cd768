// What the eight renderings of mix.frag read, each once.

out vec3 eyePosition;
out vec3 eyeNormal;
#if COUNT > 5
out vec3 modelPosition;
#endif
#if COUNT > 6
out vec3 modelNormal;
#endif
out vec4 color;
#if COUNT > 1
out vec2 place;
#endif

void main()
{
    eyePosition = vec3(gl_ModelViewMatrix * gl_Vertex);
    eyeNormal = gl_NormalMatrix * gl_Normal;
#if COUNT > 5
    modelPosition = gl_Vertex.xyz;
#endif
#if COUNT > 6
    modelNormal = gl_Normal;
#endif
    color = gl_Color;
#if COUNT > 1
    place = vec2(gl_TextureMatrix[0] * gl_MultiTexCoord0);
#endif
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
