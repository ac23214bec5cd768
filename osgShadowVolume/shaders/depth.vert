// Depths of surfaces, as their own programs give them. OSGSV_INSTANCE: follows the GLSL of a
// VertexSnippet.
invariant gl_Position;

void main()
{
#ifdef OSGSV_INSTANCE
    vec4 vertex = gl_Vertex, color = gl_Color;
    vec3 normal = gl_Normal;
    osgmr_instance(vertex, normal, color);
    gl_ClipVertex = gl_ModelViewMatrix * vertex;
    gl_Position = gl_ModelViewProjectionMatrix * vertex;
#else
    gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;
    gl_Position = ftransform();
#endif
}
