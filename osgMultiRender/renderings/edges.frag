#version 120

// A drawing of feature edges: outlines and where the surface bends sharply, of even width. Flat
// sides differ by their tone; the edge between two of them is none that one pass can see.

uniform float width; // = 2 [0.5, 8]
uniform float bend; // = 0.12 [0.01, 1]
uniform vec3 ink; // = 0.05 0.07 0.12 [0, 1]
uniform vec3 paper; // = 0.96 0.97 0.98 [0, 1]
uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec3 eyePosition;
varying vec3 eyeNormal;

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

void main()
{
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    float facing = dot(normal, -normalize(eyePosition));
    // How far the outline is, in pixels.
    float pixels = facing / max(length(vec2(dFdx(facing), dFdy(facing))), 0.01);
    float outline = 1.0 - smoothstep(width - 0.5, width + 0.5, pixels);
    // How much the normal turns within a pixel, seen from the front.
    vec3 turnX = dFdx(normal), turnY = dFdy(normal);
    float turn = sqrt(dot(turnX, turnX) + dot(turnY, turnY)) * max(facing, 0.0);
    float crease = smoothstep(bend, 1.5 * bend, turn);
    float shade = 0.3 * max(1.0 - brightness(diffuseLight(normal, eyePosition)), 0.0);
    gl_FragColor = vec4(mix(paper * (1.0 - shade), ink, max(outline, crease)), 1.0);
}
