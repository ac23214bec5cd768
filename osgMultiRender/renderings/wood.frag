#version 120

// A solid block of wood that the model is cut from: rings around the z axis, fibres along it.

uniform float rings; // = 6 [0.1, 50]
uniform vec3 light; // = 0.76 0.52 0.30 [0, 1]
uniform vec3 dark; // = 0.45 0.24 0.11 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;

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
    vec3 pixel = fwidth(at);
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
    vec3 toLight = lightDirection(eyePosition);
    float diffuse = max(dot(normal, toLight), 0.0);
    float mirrored = max(dot(reflect(-toLight, normal), -normalize(eyePosition)), 1e-6);
    gl_FragColor = vec4(grain * (0.25 + 0.75 * diffuse) + 0.12 * pow(mirrored, 20.0), 1.0);
}
