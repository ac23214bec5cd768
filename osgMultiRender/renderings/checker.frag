#version 120

// A checker board in the model's space, antialiased by integrals over the pixel.

uniform float squares; // = 4 [0.05, 100]
uniform vec3 light; // = 0.93 0.91 0.85 [0, 1]
uniform vec3 dark; // = 0.18 0.22 0.28 [0, 1]
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

// Unit normal of the side that is seen.
vec3 seenNormal(vec3 normal, vec3 position)
{
    vec3 n = normalize(normal);
    return faceforward(n, position, n);
}

// Mean over a width of a square wave of period 2: its integral is a triangle wave.
vec3 wave(vec3 at, vec3 width)
{
    vec3 low = abs(2.0 * fract(0.5 * (at - 0.5 * width)) - 1.0);
    vec3 high = abs(2.0 * fract(0.5 * (at + 0.5 * width)) - 1.0);
    return (low - high) / width;
}

void main()
{
    vec3 at = modelPosition * squares;
    // Cut just beside whole numbers, where sides of boxes lie.
    vec3 wide = fwidth(modelPosition) * squares;
    vec3 mean = wave(at + 0.013, max(wide, 1e-4));
    float odd = 0.5 + 0.5 * mean.x * mean.y * mean.z;
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    vec3 diffuse = diffuseLight(normal, eyePosition);
    gl_FragColor = vec4(mix(dark, light, odd) * (0.25 + 0.75 * diffuse), 1.0);
}
