// What a mirror writes: the picture that it reflects over its own surface, by reflectivity.
uniform sampler2D osgsv_reflection;
// From window to texels, left and right exchanged; reflectivity; 1 where the surface is blended.
uniform vec4 osgsv_mirror;

vec4 osgmr_output(vec4 surface)
{
    vec2 texel = vec2(osgsv_mirror.x - gl_FragCoord.x, gl_FragCoord.y - osgsv_mirror.y);
    vec3 reflected = texelFetch(osgsv_reflection, ivec2(texel), 0).rgb;
    float share = osgsv_mirror.z;
    if (osgsv_mirror.w == 0.0)
        return vec4(mix(surface.rgb, reflected, share), surface.a);
    // Glass lets less of what is behind it through, and its reflection is as bright as any: blended
    // by alpha, (1 - share) of the blended surface and the share of the reflection must come out.
    float alpha = 1.0 - (1.0 - share) * (1.0 - surface.a);
    vec3 color = (1.0 - share) * surface.a * surface.rgb + share * reflected;
    return vec4(alpha > 0.0 ? color / alpha : surface.rgb, alpha);
}
