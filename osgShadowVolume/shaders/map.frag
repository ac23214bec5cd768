// Visibility of lights from depth maps, one layer each, six for a point light.
//
// A light is five texels of osgsv_mapData:
//   0 kind (0 parallel, 1 cone, 2 cube, -1 no map), first layer, nearest, bias
//   1-3 rows of the matrix from eye coordinates to those of the map
//   4 spread, samples on a side
// What they mean, ShadowMapFit.h says.
uniform sampler2DArrayShadow osgsv_maps;
uniform sampler2D osgsv_mapData;

vec4 osgsv_mapTexel(int index, int texel)
{
    return texelFetch(osgsv_mapData, ivec2((index & 255) * 5 + texel, index >> 8), 0);
}

// The share of the square of texels around a point that the light reaches.
float osgsv_filtered(vec2 uv, float layer, float depth, int samples)
{
    float texel = 1.0 / float(textureSize(osgsv_maps, 0).x);
    vec2 first = uv - 0.5 * texel * float(samples - 1);
    float visible = 0.0;
    for (int y = 0; y < samples; ++y)
        for (int x = 0; x < samples; ++x)
            // With gradients of its own: this may run in a branch.
            visible += textureGrad(osgsv_maps,
                                   vec4(first + texel * vec2(ivec2(x, y)), layer, depth),
                                   vec2(0.0), vec2(0.0));
    return visible / float(samples * samples);
}

float osgsv_visible(float shadow, vec3 position)
{
    int index = int(shadow);
    vec4 map = osgsv_mapTexel(index, 0);
    if (map.x < 0.0)
        return 1.0;
    vec4 more = osgsv_mapTexel(index, 4);
    vec4 point = vec4(position, 1.0);
    vec3 d = vec3(dot(osgsv_mapTexel(index, 1), point), dot(osgsv_mapTexel(index, 2), point),
                  dot(osgsv_mapTexel(index, 3), point));
    float layer = map.y;
    vec3 at = vec3(d.xy, d.z - map.w);
    if (map.x > 0.0)
    {
        if (map.x == 2.0)
        {
            vec3 size = abs(d);
            int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            vec3 along = axis == 0 ? d.yzx : axis == 1 ? d.zxy : d;
            layer += float(2 * axis + (along.z < 0.0 ? 1 : 0));
            d = vec3(along.xy, abs(along.z));
        }
        if (!(d.z > 0.0))
            return 1.0;
        at = vec3(0.5 + 0.5 * d.xy / (d.z * more.x), 1.0 - map.z / (d.z * (1.0 - map.w)));
    }
    // Outside there is no caster, or no light.
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0))))
        return 1.0;
    return osgsv_filtered(at.xy, layer, min(at.z, 1.0), int(more.y));
}
