// Turns the counts of a light into its bit: not zero is in shadow.
#if OSGSV_SAMPLES > 1
uniform sampler2DMS osgsv_counter;
#define OSGSV_COUNT texelFetch(osgsv_counter, ivec2(gl_FragCoord.xy), gl_SampleID).r
#else
uniform sampler2D osgsv_counter;
#define OSGSV_COUNT texelFetch(osgsv_counter, ivec2(gl_FragCoord.xy), 0).r
#endif
uniform int osgsv_bit; // -1 clears all bits
layout(location = 0) out uvec4 osgsv_bits;

void main()
{
    if (osgsv_bit >= 0 && OSGSV_COUNT == 0.0)
        discard;
    osgsv_bits = uvec4(osgsv_bit < 0 ? 0u : 1u << osgsv_bit);
}
