#version 120

// Procedural bump mapping: hammered metal, its dents made of noise in the model's space.

uniform float dents; // = 12 [0.1, 100]
uniform float depth; // = 0.35 [0, 1]
uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec3 modelPosition;
varying vec3 modelNormal;
varying vec4 color;

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
    vec3 diffuse = diffuseLight(normal, eyePosition);
    vec3 mirrored = mirroredLight(normal, eyePosition, 24.0);
    vec4 surface = surfaceColor();
    gl_FragColor = vec4(surface.rgb * (0.2 + 0.7 * diffuse) + 0.5 * mirrored, surface.a);
}
