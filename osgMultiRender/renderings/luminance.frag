#version 120

// The image in grey, by what the eye takes for bright.

uniform sampler2D image; // = 0

varying vec2 place;

float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

void main()
{
    vec4 texel = texture2D(image, place);
    gl_FragColor = vec4(vec3(luminance(texel.rgb)), texel.a);
}
