#version 120

// Pen strokes along slices of the model, crossed where it is dark, equally dense on the screen
// however near the surface is.

uniform float spacing; // = 7 [3, 30]
uniform float weight; // = 1 [0.2, 3]
uniform vec3 ink; // = 0.1 0.1 0.2 [0, 1]
uniform vec3 paper; // = 0.97 0.95 0.9 [0, 1]
uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;

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

float brightness(vec3 light)
{
    return max(max(light.r, light.g), light.b);
}

// Unit normal of the side that is seen.
vec3 seenNormal(vec3 normal, vec3 position)
{
    vec3 n = normalize(normal);
    return faceforward(n, position, n);
}

// Share of a pixel that a stroke covers; a share of their spacing is stroke, `pixel` of it a pixel.
float strokes(float at, float pixel, float share)
{
    float middle = abs(fract(at + 0.5) - 0.5);
    float low = max(-0.5 * share, middle - 0.5 * pixel), high = min(0.5 * share, middle + 0.5 * pixel);
    return clamp((high - low) / pixel, 0.0, 1.0);
}

// Strokes where the model meets planes across a direction. Their distance is a power of two of
// the model's units, so that they stay on the surface; every second one fades as it comes near.
float slices(vec3 direction, float share)
{
    float at = dot(modelPosition, direction);
    float level = log2(max(length(vec2(dFdx(at), dFdy(at))), 1e-12) * spacing);
    float scale = exp2(-floor(level)), fine = 1.0 - fract(level);
    float pixel = exp2(fract(level)) / spacing;
    float both = strokes(at * scale, pixel, share * exp2(fract(level)) * fine);
    float coarse = strokes(0.5 * at * scale, 0.5 * pixel, 0.5 * share * exp2(fract(level)));
    return max(both, coarse);
}

void main()
{
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    float dark = max(1.0 - brightness(diffuseLight(normal, eyePosition)), 0.0);
    float first = slices(vec3(0.64, 0.60, 0.48), weight * 0.35 * smoothstep(0.15, 0.7, dark));
    float second = slices(vec3(-0.60, 0.64, 0.48), weight * 0.35 * smoothstep(0.5, 1.0, dark));
    float facing = dot(normal, -normalize(eyePosition));
    float line = 1.5 * max(fwidth(facing), 0.02);
    float outline = 1.0 - smoothstep(0.5 * line, line, facing);
    gl_FragColor = vec4(mix(paper, ink, max(max(first, second), outline)), 1.0);
}
