#version 120

// Phong shading: the material under light 0, computed at each pixel, with a round highlight.

uniform float gloss; // = 40 [1, 200]
uniform float highlight; // = 0.5 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec4 color;

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

// What the surface reflects: its material, tinted by its vertices.
vec4 surfaceColor()
{
    return gl_FrontMaterial.diffuse * color;
}

void main()
{
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    vec3 toLight = lightDirection(eyePosition);
    float diffuse = max(dot(normal, toLight), 0.0);
    float mirrored = max(dot(reflect(-toLight, normal), -normalize(eyePosition)), 1e-6);
    float specular = diffuse > 0.0 ? highlight * pow(mirrored, gloss) : 0.0;
    vec4 surface = surfaceColor();
    gl_FragColor = vec4(surface.rgb * (0.15 + 0.85 * diffuse) + specular, surface.a);
}
