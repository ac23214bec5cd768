#version 120

// A solid block of wood that the model is cut from: rings around the z axis, fibres along it.

uniform float rings; // = 6 [0.1, 50]
uniform vec3 light; // = 0.76 0.52 0.30 [0, 1]
uniform vec3 dark; // = 0.45 0.24 0.11 [0, 1]
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

// What of these lights it mirrors into the eye.
vec3 mirroredLight(vec3 normal, vec3 position, float gloss)
{
    vec3 sum = vec3(0.0);
    vec3 toEye = -normalize(position);
    int on = osg_EnabledLights, end = lightsEnd();
    for (int left = end; left > 0; --left)
    {
        int i = end - left;
        if (on - on / 2 * 2 == 1)
        {
            vec4 light = lightAt(i, position);
            float mirrored = max(dot(reflect(-light.xyz, normal), toEye), 1e-6);
            if (dot(normal, light.xyz) > 0.0)
                sum += light.w * pow(mirrored, gloss) * gl_LightSource[i].diffuse.rgb;
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

// 0 to 1, from whole numbers.
float cellNoise(vec3 cell)
{
    vec3 x = fract(mod(cell, 64.0) * vec3(0.3819, 0.2763, 0.4437)) + 0.5;
    x = fract(x * (x.yzx + 2.7) * (x.zxy + 5.3));
    x = fract((x + 0.5) * (x.yzx + 3.1) * (x.zxy + 7.9));
    return fract(x.x + x.y + x.z);
}

// -1 to 1, smooth, with features of size 1.
float noise(vec3 at)
{
    vec3 cell = floor(at);
    vec3 f = at - cell;
    f = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    vec4 low = vec4(cellNoise(cell), cellNoise(cell + vec3(1.0, 0.0, 0.0)),
                    cellNoise(cell + vec3(0.0, 1.0, 0.0)), cellNoise(cell + vec3(1.0, 1.0, 0.0)));
    vec4 high = vec4(cellNoise(cell + vec3(0.0, 0.0, 1.0)), cellNoise(cell + vec3(1.0, 0.0, 1.0)),
                     cellNoise(cell + vec3(0.0, 1.0, 1.0)), cellNoise(cell + vec3(1.0, 1.0, 1.0)));
    vec4 z = mix(low, high, f.z);
    vec2 y = mix(z.xy, z.zw, f.y);
    return 2.0 * mix(y.x, y.y, f.x) - 1.0;
}

void main()
{
    vec3 at = modelPosition * rings;
    vec3 pixel = fwidth(modelPosition) * rings;
    float size = max(max(pixel.x, pixel.y), pixel.z);
    vec3 bent = at + 0.35 * noise(at * vec3(0.5, 0.5, 0.15)) + 0.1 * noise(at * vec3(1.3, 1.3, 0.4));
    float radius = length(bent.xy);
    float around = fract(radius);
    // Slow from light to dark, then back within a tenth; the mean of it where rings are too fine.
    float ring = smoothstep(0.1, 0.9, around) * (1.0 - smoothstep(0.9, 1.0, around));
    ring = mix(ring, 0.45, smoothstep(0.3, 1.0, size));
    float fibre = noise(at * vec3(14.0, 14.0, 0.6)) * (1.0 - smoothstep(0.03, 0.1, size));
    vec3 grain = mix(light, dark, ring) * (1.0 + 0.12 * fibre);
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    vec3 diffuse = diffuseLight(normal, eyePosition);
    vec3 mirrored = mirroredLight(normal, eyePosition, 20.0);
    gl_FragColor = vec4(grain * (0.25 + 0.75 * diffuse) + 0.12 * mirrored, 1.0);
}
