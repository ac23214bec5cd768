#version 120

// The brightest of the neighbours, channel by channel: bright parts grow.

uniform sampler2D image; // = 0
uniform vec2 imageSize; // = 0 0
uniform int radius; // = 1 [0, 8]

varying vec2 place;

// One texel to the right and one up, in texture coordinates; a pixel of the screen where the
// size of the image is not known.
mat2 texelSteps()
{
    if (imageSize.x > 0.0 && imageSize.y > 0.0)
        return mat2(1.0 / imageSize.x, 0.0, 0.0, 1.0 / imageSize.y);
    return mat2(dFdx(place), dFdy(place));
}

void main()
{
    mat2 texel = texelSteps();
    vec4 most = vec4(0.0);
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            most = max(most, texture2D(image, place + texel * vec2(float(x), float(y))));
    gl_FragColor = most;
}
