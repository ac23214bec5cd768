#version 120

// The model's texture of unit 0, lit by light 0 as far as asked for.

uniform sampler2D image; // = 0
uniform float shading; // = 0.7 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec4 color;
varying vec2 place;

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
    float diffuse = max(dot(normal, lightDirection(eyePosition)), 0.0);
    vec4 texel = texture2D(image, place) * color;
    gl_FragColor = vec4(texel.rgb * mix(1.0, 0.2 + 0.8 * diffuse, shading), texel.a);
}
