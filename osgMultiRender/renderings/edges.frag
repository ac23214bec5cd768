#version 120

// A drawing of feature edges: outlines and where the surface bends sharply, of even width. Flat
// sides differ by their tone; the edge between two of them is none that one pass can see.

uniform float width; // = 2 [0.5, 8]
uniform float bend; // = 0.12 [0.01, 1]
uniform vec3 ink; // = 0.05 0.07 0.12 [0, 1]
uniform vec3 paper; // = 0.96 0.97 0.98 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;

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
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    float facing = dot(normal, -normalize(eyePosition));
    // How far the outline is, in pixels.
    float pixels = facing / max(length(vec2(dFdx(facing), dFdy(facing))), 0.01);
    float outline = 1.0 - smoothstep(width - 0.5, width + 0.5, pixels);
    // How much the normal turns within a pixel, seen from the front.
    vec3 turnX = dFdx(normal), turnY = dFdy(normal);
    float turn = sqrt(dot(turnX, turnX) + dot(turnY, turnY)) * max(facing, 0.0);
    float crease = smoothstep(bend, 1.5 * bend, turn);
    float shade = 0.3 * (1.0 - max(dot(normal, lightDirection(eyePosition)), 0.0));
    gl_FragColor = vec4(mix(paper * (1.0 - shade), ink, max(outline, crease)), 1.0);
}
