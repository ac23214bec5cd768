#version 120

// Gooch shading: warm where the light is, cool where it is not, never black, so that shape can be
// read everywhere.

uniform vec3 cool; // = 0.15 0.25 0.6 [0, 1]
uniform vec3 warm; // = 0.95 0.85 0.55 [0, 1]
uniform float tint; // = 0.3 [0, 1]

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
    vec3 toEye = -normalize(eyePosition);
    vec4 surface = surfaceColor();
    float warmth = clamp(0.35 + 0.65 * dot(normal, toLight), 0.0, 1.0);
    vec3 tone = mix(mix(cool, surface.rgb, tint), mix(warm, surface.rgb, tint), warmth);
    float mirrored = max(dot(reflect(-toLight, normal), toEye), 0.0);
    float facing = dot(normal, toEye);
    float line = 1.5 * max(fwidth(facing), 0.02);
    tone = mix(tone, vec3(1.0), 0.6 * smoothstep(0.93, 0.99, mirrored));
    gl_FragColor = vec4(tone * smoothstep(0.5 * line, line, facing), surface.a);
}
