#version 120

// Cel shading: few flat tones with smooth borders of a pixel, and dark outlines.

uniform float tones; // = 3 [2, 8]
uniform float outline; // = 2 [0, 6]

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
    float facing = dot(normal, -normalize(eyePosition));
    float diffuse = max(dot(normal, lightDirection(eyePosition)), 0.0) * (tones - 0.01);
    float pixel = max(fwidth(diffuse), 1e-5);
    // A step up just before each whole number, as wide as a pixel.
    float tone = floor(diffuse) + clamp((fract(diffuse) - 1.0) / pixel + 1.0, 0.0, 1.0);
    float shade = mix(0.3, 1.0, clamp(tone / (tones - 1.0), 0.0, 1.0));
    float line = outline * max(fwidth(facing), 0.02);
    float ink = outline > 0.0 ? smoothstep(0.5 * line, line, facing) : 1.0;
    vec4 surface = surfaceColor();
    gl_FragColor = vec4(surface.rgb * shade * ink, surface.a);
}
