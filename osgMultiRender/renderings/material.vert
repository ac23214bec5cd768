#version 120

// Gouraud shading: the material under light 0, computed at the vertices.

varying vec4 litColor;

// Towards light 0.
vec3 lightDirection(vec3 position)
{
    vec4 source = gl_LightSource[0].position;
    return normalize(source.w == 0.0 ? source.xyz : source.xyz / source.w - position);
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
    vec3 toLight = lightDirection(position);
    vec3 halfway = normalize(toLight - normalize(position));
    float diffuse = max(dot(normal, toLight), 0.0);
    float specular =
        diffuse > 0.0 ? pow(max(dot(normal, halfway), 1e-6), gl_FrontMaterial.shininess) : 0.0;
    vec3 ambient = gl_FrontMaterial.ambient.rgb *
                   (gl_LightModel.ambient.rgb + gl_LightSource[0].ambient.rgb);
    vec3 lit = ambient + diffuse * gl_FrontMaterial.diffuse.rgb * gl_LightSource[0].diffuse.rgb;
    litColor.rgb = gl_FrontMaterial.emission.rgb + gl_Color.rgb * lit +
                   specular * gl_FrontMaterial.specular.rgb * gl_LightSource[0].specular.rgb;
    litColor.a = gl_FrontMaterial.diffuse.a * gl_Color.a;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
