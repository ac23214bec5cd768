#version 120

// Procedural bump mapping: hammered metal, its dents made of noise in the model's space.

uniform float dents; // = 12 [0.1, 100]
uniform float depth; // = 0.35 [0, 1]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;
varying vec3 modelNormal;
varying vec4 color;

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

// What the surface reflects: its material, tinted by its vertices.
vec4 surfaceColor()
{
    return gl_FrontMaterial.diffuse * color;
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
    vec3 at = modelPosition * dents;
    vec3 pixel = fwidth(at);
    // Dents smaller than two pixels are flat.
    float seen = depth * (1.0 - smoothstep(0.5, 1.0, max(max(pixel.x, pixel.y), pixel.z)));
    float height = noise(at);
    vec3 slope = vec3(noise(at + vec3(0.1, 0.0, 0.0)), noise(at + vec3(0.0, 0.1, 0.0)),
                      noise(at + vec3(0.0, 0.0, 0.1))) - height;
    vec3 flatNormal = normalize(modelNormal);
    slope -= dot(slope, flatNormal) * flatNormal;
    vec3 normal = seenNormal(gl_NormalMatrix * (flatNormal - seen * 10.0 * slope), eyePosition);
    vec3 toLight = lightDirection(eyePosition);
    float diffuse = max(dot(normal, toLight), 0.0);
    float mirrored = max(dot(reflect(-toLight, normal), -normalize(eyePosition)), 1e-6);
    vec4 surface = surfaceColor();
    gl_FragColor =
        vec4(surface.rgb * (0.2 + 0.7 * diffuse) + 0.5 * pow(mirrored, 24.0), surface.a);
}
