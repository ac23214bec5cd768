#version 120

// Gouraud shading: the material under all lights, computed at the vertices.

uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec4 litColor;

// The unit vector to a light, and how much of it arrives: by distance and cone.
vec4 lightAt(int number, vec3 position)
{
    vec4 source = gl_LightSource[number].position;
    vec3 way = source.w == 0.0 ? source.xyz : source.xyz / source.w - position;
    float far = max(length(way), 1e-20);
    vec3 direction = way / far;
    float share = 1.0 / max(gl_LightSource[number].constantAttenuation +
                                far * (gl_LightSource[number].linearAttenuation +
                                       far * gl_LightSource[number].quadraticAttenuation),
                            1e-30);
    float cosine = dot(-direction, normalize(gl_LightSource[number].spotDirection));
    float cone = pow(max(cosine, 1e-6), gl_LightSource[number].spotExponent);
    cone = cosine < gl_LightSource[number].spotCosCutoff ? 0.0 : cone;
    // Choices, not branches: compilers compute equal ones of several renderings once.
    return vec4(direction, (source.w == 0.0 ? 1.0 : share) *
                               (gl_LightSource[number].spotCutoff > 90.0 ? 1.0 : cone));
}

// Unit normal of the side that is seen.
vec3 seenNormal(vec3 normal, vec3 position)
{
    vec3 n = normalize(normal);
    return faceforward(n, position, n);
}

void main()
{
    vec3 position = vec3(gl_ModelViewMatrix * gl_Vertex);
    vec3 normal = seenNormal(gl_NormalMatrix * gl_Normal, position);
    vec3 matt = gl_FrontMaterial.ambient.rgb * gl_LightModel.ambient.rgb, gloss = vec3(0.0);
    int on = osg_EnabledLights; // bits of their numbers, lowest first
    for (int i = 0; on > 0; ++i)
    {
        if (on - on / 2 * 2 == 1)
        {
            vec4 light = lightAt(i, position);
            float diffuse = max(dot(normal, light.xyz), 0.0);
            // The eye is far away, as it is for GL unless the light model says otherwise.
            vec3 halfway = normalize(light.xyz + vec3(0.0, 0.0, 1.0));
            float specular =
                diffuse > 0.0 ? pow(max(dot(normal, halfway), 1e-6), gl_FrontMaterial.shininess)
                              : 0.0;
            matt += light.w * (gl_FrontMaterial.ambient.rgb * gl_LightSource[i].ambient.rgb +
                               diffuse * gl_FrontMaterial.diffuse.rgb * gl_LightSource[i].diffuse.rgb);
            gloss += light.w * specular * gl_FrontMaterial.specular.rgb *
                     gl_LightSource[i].specular.rgb;
        }
        on /= 2;
    }
    litColor.rgb = clamp(gl_FrontMaterial.emission.rgb + gl_Color.rgb * matt + gloss, 0.0, 1.0);
    litColor.a = gl_FrontMaterial.diffuse.a * gl_Color.a;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
