#version 120

// The image crisper: what differs from the mean of its neighbours differs more.

uniform sampler2D image; // = 0
uniform vec2 imageSize; // = 0 0
uniform float strength; // = 1 [0, 4]

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
    vec4 middle = texture2D(image, place);
    vec3 mean = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
        {
            vec2 at = vec2(float(x), float(y));
            float weight = (2.0 - abs(at.x)) * (2.0 - abs(at.y)) / 16.0;
            mean += weight * texture2D(image, place + texel * at).rgb;
        }
    gl_FragColor = vec4(clamp(middle.rgb + strength * (middle.rgb - mean), 0.0, 1.0), middle.a);
}
