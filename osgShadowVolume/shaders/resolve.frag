// Turns the counts of a light into its bit: not zero is in shadow.
#if OSGSV_SAMPLES > 1
uniform sampler2DMS osgsv_counter;
#define OSGSV_COUNT texelFetch(osgsv_counter, osgsv_texel(), gl_SampleID).r
#else
uniform sampler2D osgsv_counter;
#define OSGSV_COUNT texelFetch(osgsv_counter, osgsv_texel(), 0).r
#endif
uniform int osgsv_bit; // -1 clears all bits
layout(location = 0) out uvec4 osgsv_bits;

uniform int osgsv_flippedHeight; // where rows count from the top, else 0

ivec2 osgsv_texel()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    return osgsv_flippedHeight > 0 ? ivec2(texel.x, osgsv_flippedHeight - 1 - texel.y) : texel;
}

void main()
{
    if (osgsv_bit >= 0 && OSGSV_COUNT == 0.0)
        discard;
    osgsv_bits = uvec4(osgsv_bit < 0 ? 0u : 1u << osgsv_bit);
}
