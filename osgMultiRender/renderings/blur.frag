#version 120

// The image out of focus: a bell of weights, `radius` texels wide.

uniform sampler2D image; // = 0
uniform vec2 imageSize; // = 0 0
uniform int radius; // = 4 [0, 12]

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
    float falloff = -2.0 / max(float(radius * radius), 1e-6);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
        {
            vec2 at = vec2(float(x), float(y));
            float weight = exp(falloff * dot(at, at));
            sum += weight * texture2D(image, place + texel * at);
            weights += weight;
        }
    gl_FragColor = sum / weights;
}
