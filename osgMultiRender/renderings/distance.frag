#version 120

// White near the eye, black far from it, with the shape faintly shaded.

uniform float nearest; // = 1 [0, 1000]
uniform float farthest; // = 20 [0, 10000]
uniform float shading; // = 0.25 [0, 1]

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
    float far = clamp((length(eyePosition) - nearest) / max(farthest - nearest, 1e-6), 0.0, 1.0);
    float facing = dot(seenNormal(eyeNormal, eyePosition), -normalize(eyePosition));
    gl_FragColor = vec4(vec3((1.0 - far) * mix(1.0, facing, shading)), 1.0);
}
