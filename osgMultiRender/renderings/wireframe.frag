#version 120

// A frame of wires where the model meets the planes of a lattice, of even width on the screen;
// needs no knowledge of its triangles.

uniform float lines; // = 5 [0.05, 100]
uniform float width; // = 1.2 [0.5, 8]
uniform vec3 wire; // = 0.25 0.9 0.75 [0, 1]
uniform vec3 between; // = 0.03 0.06 0.09 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;
varying vec3 modelNormal;

// Unit normal of the side that is seen.
vec3 seenNormal(vec3 normal, vec3 position)
{
    vec3 n = normalize(normal);
    return faceforward(n, position, n);
}

void main()
{
    vec3 at = modelPosition * lines;
    vec3 pixel = max(fwidth(at), 1e-5);
    vec3 pixels = abs(fract(at - 0.5) - 0.5) / pixel;
    vec3 line = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, pixels);
    // Planes that the surface lies in, or that are closer than their wires, show no wire but its
    // mean.
    vec3 normal = normalize(modelNormal);
    line *= smoothstep(0.0, 0.15, 1.0 - abs(normal));
    line = mix(line, clamp(width * pixel, 0.0, 0.6), smoothstep(0.2, 0.5, pixel));
    float facing = dot(seenNormal(eyeNormal, eyePosition), -normalize(eyePosition));
    float border = 1.0 - smoothstep(0.0, 2.0 * max(fwidth(facing), 0.02), facing);
    float drawn = max(max(line.x, line.y), max(line.z, border));
    gl_FragColor = vec4(mix(between, wire * (0.45 + 0.55 * facing), drawn), 1.0);
}
