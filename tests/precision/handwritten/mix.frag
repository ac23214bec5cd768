// The first COUNT of eight built-in renderings mixed by hand: what they have in common is computed
// once, derivatives are taken outside of branches, everything else within them.

in vec3 eyePosition;
in vec3 eyeNormal;
#if COUNT > 5
in vec3 modelPosition;
#endif
#if COUNT > 6
in vec3 modelNormal;
#endif
in vec4 color;
#if COUNT > 1
in vec2 place;
#endif

uniform float phong_gloss, phong_highlight;
uniform sampler2D textured_image;
uniform float textured_shading;
uniform vec3 xray_glow, xray_body;
uniform float xray_rim;
uniform float toon_tones, toon_outline;
uniform vec3 gooch_cool, gooch_warm;
uniform float gooch_tint;
uniform float checker_squares;
uniform vec3 checker_light, checker_dark;
uniform float bricks_bricks, bricks_joint;
uniform vec3 bricks_brick, bricks_mortar;
uniform float wood_rings;
uniform vec3 wood_light, wood_dark;

vec3 wave(vec3 at, vec3 width)
{
    vec3 low = abs(2.0 * fract(0.5 * (at - 0.5 * width)) - 1.0);
    vec3 high = abs(2.0 * fract(0.5 * (at + 0.5 * width)) - 1.0);
    return (low - high) / width;
}

vec2 solid(vec2 at)
{
    return floor(at) * (1.0 - bricks_joint) + max(fract(at) - bricks_joint, 0.0);
}

float cellNoise(vec2 cell)
{
    vec2 x = fract(mod(cell, 64.0) * vec2(0.3819, 0.2763)) + 0.5;
    x = fract(x * (x.yx + 2.7) * 7.3);
    x = fract((x + 0.5) * (x.yx + 3.1) * 9.7);
    return fract(x.x + x.y);
}

#if COUNT > 6
vec3 bricks(vec3 wide)
{
    vec3 side = abs(modelNormal);
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
    vec2 scale = bricks_bricks * vec2(1.0, 2.0);
    at *= scale;
    pixel = max(pixel * scale, 1e-5);
    at.x += 0.5 * mod(floor(at.y), 2.0);
    vec2 share = clamp((solid(at + 0.5 * pixel) - solid(at - 0.5 * pixel)) / pixel, 0.0, 1.0);
    float single = 1.0 - smoothstep(0.3, 1.0, max(pixel.x, pixel.y));
    vec3 burnt = bricks_brick * (1.0 + 0.3 * single * (cellNoise(floor(at)) - 0.5));
    return mix(bricks_mortar, burnt, share.x * share.y);
}
#endif

float cellNoise(vec3 cell)
{
    vec3 x = fract(mod(cell, 64.0) * vec3(0.3819, 0.2763, 0.4437)) + 0.5;
    x = fract(x * (x.yzx + 2.7) * (x.zxy + 5.3));
    x = fract((x + 0.5) * (x.yzx + 3.1) * (x.zxy + 7.9));
    return fract(x.x + x.y + x.z);
}

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

#if COUNT > 7
vec3 wood(vec3 wide)
{
    vec3 at = modelPosition * wood_rings;
    vec3 pixel = wide * wood_rings;
    float size = max(max(pixel.x, pixel.y), pixel.z);
    vec3 bent = at + 0.35 * noise(at * vec3(0.5, 0.5, 0.15)) + 0.1 * noise(at * vec3(1.3, 1.3, 0.4));
    float around = fract(length(bent.xy));
    float ring = smoothstep(0.1, 0.9, around) * (1.0 - smoothstep(0.9, 1.0, around));
    ring = mix(ring, 0.45, smoothstep(0.3, 1.0, size));
    float fibre = noise(at * vec3(14.0, 14.0, 0.6)) * (1.0 - smoothstep(0.03, 0.1, size));
    return mix(wood_light, wood_dark, ring) * (1.0 + 0.12 * fibre);
}
#endif

// The unit vector to a light, and how much of it arrives.
vec4 lightAt(int number)
{
    vec4 source = gl_LightSource[number].position;
    vec3 way = source.w == 0.0 ? source.xyz : source.xyz / source.w - eyePosition;
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

void main()
{
    osgmr_mixAt(eyePosition);
    vec3 toEye = -normalize(eyePosition);
    vec3 normal = normalize(eyeNormal);
    normal = faceforward(normal, eyePosition, normal);
    vec3 diffuse = vec3(0.0);
    vec3 glossy = vec3(0.0);
#if COUNT > 4
    float most = -1.0, highlight = 0.0;
#endif
#if COUNT > 7
    vec3 polished = vec3(0.0);
#endif
    for (int i = 0; i < LIGHTS; ++i)
    {
        vec4 light = lightAt(i);
        vec3 arrives = light.w * gl_LightSource[i].diffuse.rgb;
        float cosine = dot(normal, light.xyz);
        float mirrored = dot(reflect(-light.xyz, normal), toEye);
        diffuse += max(cosine, 0.0) * arrives;
        if (cosine > 0.0)
        {
            glossy += pow(max(mirrored, 1e-6), phong_gloss) * arrives;
#if COUNT > 7
            polished += pow(max(mirrored, 1e-6), 20.0) * arrives;
#endif
        }
#if COUNT > 4
        float power = light.w * brightness(gl_LightSource[i].diffuse.rgb);
        most = max(most, power * cosine);
        highlight =
            max(highlight, min(power, 1.0) * smoothstep(0.93, 0.99, max(mirrored, 0.0)));
#endif
    }
    float facing = dot(normal, toEye);
    vec3 surface = gl_FrontMaterial.diffuse.rgb * color.rgb;
#if COUNT > 3
    float bright = brightness(diffuse);
    float tone = min(bright, 1.0) * (toon_tones - 0.01);
    float tonePixel = max(fwidth(tone), 1e-5);
    float facingPixel = max(fwidth(facing), 0.02);
#endif
#if COUNT > 5
    vec3 wide = fwidth(modelPosition);
#endif

    vec4 sum = vec4(0.0);
    float weight = osgmr_weight(0);
    if (weight > 0.0)
        sum += weight * vec4(surface * (0.15 + 0.85 * diffuse) + phong_highlight * glossy, 1.0);
#if COUNT > 1
    vec4 texel = texture(textured_image, place);
    weight = osgmr_weight(1);
    if (weight > 0.0)
        sum += weight * vec4(texel.rgb * color.rgb *
                                 mix(vec3(1.0), 0.2 + 0.8 * diffuse, textured_shading),
                             1.0);
#endif
#if COUNT > 2
    weight = osgmr_weight(2);
    if (weight > 0.0)
        sum += weight *
               vec4(mix(xray_body, xray_glow, pow(clamp(1.0 - facing, 1e-4, 1.0), xray_rim)), 1.0);
#endif
#if COUNT > 3
    weight = osgmr_weight(3);
    if (weight > 0.0)
    {
        float step = floor(tone) + clamp((fract(tone) - 1.0) / tonePixel + 1.0, 0.0, 1.0);
        float shade = mix(0.3, 1.0, clamp(step / (toon_tones - 1.0), 0.0, 1.0));
        float line = toon_outline * facingPixel;
        float ink = toon_outline > 0.0 ? smoothstep(0.5 * line, line, facing) : 1.0;
        vec3 hue = bright > 1e-4 ? diffuse / bright : vec3(1.0);
        sum += weight * vec4(surface * hue * shade * ink, 1.0);
    }
#endif
#if COUNT > 4
    weight = osgmr_weight(4);
    if (weight > 0.0)
    {
        float warmth = clamp(0.35 + 0.65 * most, 0.0, 1.0);
        vec3 shown = mix(mix(gooch_cool, surface, gooch_tint), mix(gooch_warm, surface, gooch_tint),
                         warmth);
        float line = 1.5 * facingPixel;
        shown = mix(shown, vec3(1.0), 0.6 * highlight);
        sum += weight * vec4(shown * smoothstep(0.5 * line, line, facing), 1.0);
    }
#endif
#if COUNT > 5
    weight = osgmr_weight(5);
    if (weight > 0.0)
    {
        vec3 mean = wave(modelPosition * checker_squares + 0.013, max(wide * checker_squares, 1e-4));
        float odd = 0.5 + 0.5 * mean.x * mean.y * mean.z;
        sum += weight * vec4(mix(checker_dark, checker_light, odd) * (0.25 + 0.75 * diffuse), 1.0);
    }
#endif
#if COUNT > 6
    weight = osgmr_weight(6);
    if (weight > 0.0)
        sum += weight * vec4(bricks(wide) * (0.25 + 0.75 * diffuse), 1.0);
#endif
#if COUNT > 7
    weight = osgmr_weight(7);
    if (weight > 0.0)
        sum += weight * vec4(wood(wide) * (0.25 + 0.75 * diffuse) + 0.12 * polished, 1.0);
#endif
    gl_FragColor = osgmr_mixed(sum);
}
