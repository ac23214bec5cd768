#version 120

// The image in the browns of an old print.

uniform sampler2D image; // = 0
uniform vec3 tone; // = 1 0.84 0.62 [0, 1]
uniform float strength; // = 1 [0, 1]

varying vec2 place;

float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

void main()
{
    vec4 texel = texture2D(image, place);
    // A little brighter, since the tone takes light away.
    vec3 print = min(luminance(texel.rgb) * tone * 1.15, 1.0);
    gl_FragColor = vec4(mix(texel.rgb, print, strength), texel.a);
}
