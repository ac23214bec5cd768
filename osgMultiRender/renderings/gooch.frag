#version 120

// Gooch shading: warm where the light is, cool where it is not, never black, so that shape can be
// read everywhere.

uniform vec3 cool; // = 0.15 0.25 0.6 [0, 1]
uniform vec3 warm; // = 0.95 0.85 0.55 [0, 1]
uniform float tint; // = 0.3 [0, 1]
uniform int osg_EnabledLights; // = 1 [0, 255]

varying vec3 eyePosition;
varying vec3 eyeNormal;
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

// What the surface reflects: its material, tinted by its vertices.
vec4 surfaceColor()
{
    return gl_FrontMaterial.diffuse * color;
}

void main()
{
    vec3 normal = seenNormal(eyeNormal, eyePosition);
    vec3 toEye = -normalize(eyePosition);
    vec4 surface = surfaceColor();
    // The light that counts most, so that two from opposite sides don't cancel each other.
    float most = -1.0, highlight = 0.0;
    int on = osg_EnabledLights, end = lightsEnd();
    for (int left = end; left > 0; --left)
    {
        int i = end - left;
        if (on - on / 2 * 2 == 1)
        {
            vec4 light = lightAt(i, eyePosition);
            float power = light.w * brightness(gl_LightSource[i].diffuse.rgb);
            float mirrored = max(dot(reflect(-light.xyz, normal), toEye), 0.0);
            most = max(most, power * dot(normal, light.xyz));
            highlight = max(highlight, min(power, 1.0) * smoothstep(0.93, 0.99, mirrored));
        }
        on /= 2;
    }
    float warmth = clamp(0.35 + 0.65 * most, 0.0, 1.0);
    vec3 tone = mix(mix(cool, surface.rgb, tint), mix(warm, surface.rgb, tint), warmth);
    float facing = dot(normal, toEye);
    float line = 1.5 * max(fwidth(facing), 0.02);
    tone = mix(tone, vec3(1.0), 0.6 * highlight);
    gl_FragColor = vec4(tone * smoothstep(0.5 * line, line, facing), surface.a);
}
