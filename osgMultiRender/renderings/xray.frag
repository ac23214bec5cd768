#version 120

// As on an X-ray plate: thin where seen from the front, bright along the rim.

uniform vec3 glow; // = 0.75 0.9 1 [0, 1]
uniform vec3 body; // = 0.02 0.05 0.1 [0, 1]
uniform float rim; // = 1.6 [0.2, 8]

varying vec3 eyePosition;
varying vec3 eyeNormal;

// Unit normal of the side that is seen.
vec3 seenNormal(vec3 normal, vec3 position)
{
    vec3 n = normalize(normal);
    return faceforward(n, position, n);
}

void main()
{
    float facing = dot(seenNormal(eyeNormal, eyePosition), -normalize(eyePosition));
    float thick = pow(clamp(1.0 - facing, 1e-4, 1.0), rim);
    gl_FragColor = vec4(mix(body, glow, thick), thick);
}
