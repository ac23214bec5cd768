#version 120

// Edges of the image: the size of its gradient by Sobel's two masks.

uniform sampler2D image; // = 0
uniform vec2 imageSize; // = 0 0
uniform float strength; // = 0.5 [0, 8]

varying vec2 place;

// One texel to the right and one up, in texture coordinates; a pixel of the screen where the
// size of the image is not known.
mat2 texelSteps()
{
    if (imageSize.x > 0.0 && imageSize.y > 0.0)
        return mat2(1.0 / imageSize.x, 0.0, 0.0, 1.0 / imageSize.y);
    return mat2(dFdx(place), dFdy(place));
}

float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

void main()
{
    mat2 texel = texelSteps();
    vec2 gradient = vec2(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
        {
            vec2 at = vec2(float(x), float(y));
            float bright = luminance(texture2D(image, place + texel * at).rgb);
            gradient += bright * at * (2.0 - abs(at.yx));
        }
    gl_FragColor = vec4(vec3(min(strength * length(gradient), 1.0)), 1.0);
}
