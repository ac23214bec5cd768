// What a PrimitiveBatch looks like without a kit above it: lit by light 0, which a viewer's
// headlight is. Follows instance.vert.

void main()
{
    vec4 vertex = gl_Vertex, color = gl_Color;
    vec3 normal = gl_Normal;
    osgmr_instance(vertex, normal, color);
    vec4 eye = gl_ModelViewMatrix * vertex;
    vec4 light = gl_LightSource[0].position;
    vec3 toLight = normalize(light.xyz - eye.xyz * light.w);
    float size = length(gl_NormalMatrix * normal);
    float nl = size > 0.0 ? max(dot(gl_NormalMatrix * normal, toLight) / size, 0.0) : 0.0;
    vec3 lit = gl_LightModel.ambient.rgb + gl_LightSource[0].ambient.rgb +
               nl * gl_LightSource[0].diffuse.rgb;
    gl_FrontColor = vec4(clamp(color.rgb * lit, 0.0, 1.0), color.a);
    gl_ClipVertex = eye;
    gl_Position = gl_ModelViewProjectionMatrix * vertex;
}
