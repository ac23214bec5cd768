#version 120

// A checker board in the model's space, antialiased by integrals over the pixel.

uniform float squares; // = 4 [0.05, 100]
uniform vec3 light; // = 0.93 0.91 0.85 [0, 1]
uniform vec3 dark; // = 0.18 0.22 0.28 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;

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

// Mean over a width of a square wave of period 2: its integral is a triangle wave.
vec3 wave(vec3 at, vec3 width)
{
    vec3 low = abs(2.0 * fract(0.5 * (at - 0.5 * width)) - 1.0);
    vec3 high = abs(2.0 * fract(0.5 * (at + 0.5 * width)) - 1.0);
    return (low - high) / width;
}

void main()
{
    vec3 at = modelPosition * squares;
    // Cut just beside whole numbers, where sides of boxes lie.
    vec3 mean = wave(at + 0.013, max(fwidth(at), 1e-4));
    float odd = 0.5 + 0.5 * mean.x * mean.y * mean.z;
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    float diffuse = max(dot(normal, lightDirection(eyePosition)), 0.0);
    gl_FragColor = vec4(mix(dark, light, odd) * (0.25 + 0.75 * diffuse), 1.0);
}
