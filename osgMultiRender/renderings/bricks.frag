#version 120

// A wall of bricks in the model's space, antialiased by integrals over the pixel: at any distance
// it has the colour that the eye would average.

uniform float bricks; // = 3 [0.05, 50]
uniform vec3 brick; // = 0.62 0.25 0.17 [0, 1]
uniform vec3 mortar; // = 0.80 0.77 0.72 [0, 1]
uniform float joint; // = 0.12 [0, 0.5]
uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;
varying vec3 modelNormal;

// The number behind that of the highest light that is on. Loops count down to it: indexed by their
// counter, compilers unroll them for all eight lights.
int lightsEnd()
{
    int on = osg_EnabledLights;
    return on > 15 ? on > 63 ? on > 127 ? 8 : 7 : on > 31 ? 6 : 5
                   : on > 3 ? on > 7 ? 4 : 3 : on > 1 ? 2 : on;
}

// The unit vector to a light, and how much of it arrives: by distance and cone.
vec4 lightAt(int number, vec3 position)
{
    vec4 source = gl_LightSource[number].position;
    vec3 way = source.w == 0.0 ? source.xyz : source.xyz / source.w - position;
    float far = max(length(way), 1e-20);
    vec3 direction = way / far;
    float share = 1.0 / max(gl_LightSource[number].constantAttenuation +
                                far * (gl_LightSource[number].linearAttenuation +
                                       far * gl_LightSource[number].quadraticAttenuation),
                            1e-30);
    float cosine = dot(-direction, normalize(gl_LightSource[number].spotDirection));
    float cone = pow(max(cosine, 1e-6), gl_LightSource[number].spotExponent);
    cone = cosine < gl_LightSource[number].spotCosCutoff ? 0.0 : cone;
    // Choices, not branches: compilers compute equal ones of several renderings once.
    return vec4(direction, (source.w == 0.0 ? 1.0 : share) *
                               (gl_LightSource[number].spotCutoff > 90.0 ? 1.0 : cone));
}

// What a surface gets from the lights that are on: bits of their numbers, lowest first.
vec3 diffuseLight(vec3 normal, vec3 position)
{
    vec3 sum = vec3(0.0);
    int on = osg_EnabledLights, end = lightsEnd();
    for (int left = end; left > 0; --left)
    {
        int i = end - left;
        if (on - on / 2 * 2 == 1)
        {
            vec4 light = lightAt(i, position);
            sum += light.w * max(dot(normal, light.xyz), 0.0) * gl_LightSource[i].diffuse.rgb;
        }
        on /= 2;
    }
    return sum;
}

// Unit normal of the side that is seen.
vec3 seenNormal(vec3 normal, vec3 position)
{
    vec3 n = normalize(normal);
    return faceforward(n, position, n);
}

// Integral from 0 of what is 1 for the last share (1 - joint) of each unit, 0 before.
vec2 solid(vec2 at)
{
    return floor(at) * (1.0 - joint) + max(fract(at) - joint, 0.0);
}

float cellNoise(vec2 cell)
{
    vec2 x = fract(mod(cell, 64.0) * vec2(0.3819, 0.2763)) + 0.5;
    x = fract(x * (x.yx + 2.7) * 7.3);
    x = fract((x + 0.5) * (x.yx + 3.1) * 9.7);
    return fract(x.x + x.y);
}

void main()
{
    vec3 wide = fwidth(modelPosition);
    vec3 side = abs(modelNormal);
    // The two coordinates along the side that the surface is nearest to.
    vec2 at = modelPosition.xy, pixel = wide.xy;
    if (side.x >= side.y && side.x > side.z)
    {
        at = modelPosition.yz;
        pixel = wide.yz;
    }
    else if (side.y > side.z)
    {
        at = modelPosition.xz;
        pixel = wide.xz;
    }
    vec2 scale = bricks * vec2(1.0, 2.0);
    at *= scale;
    pixel = max(pixel * scale, 1e-5);
    at.x += 0.5 * mod(floor(at.y), 2.0);
    vec2 share = clamp((solid(at + 0.5 * pixel) - solid(at - 0.5 * pixel)) / pixel, 0.0, 1.0);
    float single = 1.0 - smoothstep(0.3, 1.0, max(pixel.x, pixel.y));
    vec3 burnt = brick * (1.0 + 0.3 * single * (cellNoise(floor(at)) - 0.5));
    vec3 wall = mix(mortar, burnt, share.x * share.y);
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    vec3 diffuse = diffuseLight(normal, eyePosition);
    gl_FragColor = vec4(wall * (0.25 + 0.75 * diffuse), 1.0);
}
