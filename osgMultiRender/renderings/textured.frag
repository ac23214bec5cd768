#version 120

// The model's texture of unit 0, lit by all lights as far as asked for.

uniform sampler2D image; // = 0
uniform float shading; // = 0.7 [0, 1]
uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec4 color;
varying vec2 place;

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

void main()
{
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    vec3 diffuse = diffuseLight(normal, eyePosition);
    vec4 texel = texture2D(image, place) * color;
    gl_FragColor = vec4(texel.rgb * mix(vec3(1.0), 0.2 + 0.8 * diffuse, shading), texel.a);
}
