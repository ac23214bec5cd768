// Visibility of lights from the bits of a mask, 32 lights a word, a bit set where the light is
// taken away. Layers of the mask: the words of the opaque surfaces, then those of each transparent
// layer, nearest first (osgsv_layers holds their depths). With samples, the share of this
// fragment's samples that see the light.
#if OSGSV_SAMPLES > 1
uniform usampler2DMSArray osgsv_mask;
uniform sampler2DMSArray osgsv_layers;
#else
uniform usampler2DArray osgsv_mask;
uniform sampler2DArray osgsv_layers;
#endif
// Words (none: there is no mask), transparent layers, height where rows count from the top or 0.
uniform ivec3 osgsv_maskSize;

ivec3 osgsv_texel(int layer)
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    return ivec3(texel.x, osgsv_maskSize.z > 0 ? osgsv_maskSize.z - 1 - texel.y : texel.y, layer);
}

#ifdef OSGSV_TRANSPARENT
// The layer whose depth is this fragment's. Empty layers have depth 1.
int osgsv_layerOf(int s)
{
    int best = 0;
    float distance = 2.0;
    for (int layer = 0; layer < osgsv_maskSize.y; ++layer)
    {
        float d = abs(texelFetch(osgsv_layers, osgsv_texel(layer), s).r - gl_FragCoord.z);
        if (d < distance)
        {
            distance = d;
            best = layer;
        }
    }
    return best;
}
#endif

float osgsv_sampleVisible(int index, int s)
{
    int layer = index >> 5;
#ifdef OSGSV_TRANSPARENT
    if (osgsv_maskSize.y > 0)
        layer += (1 + osgsv_layerOf(s)) * osgsv_maskSize.x;
#endif
    uint word = texelFetch(osgsv_mask, osgsv_texel(layer), s).r;
    return (word & (1u << (index & 31))) != 0u ? 0.0 : 1.0;
}

float osgsv_visible(float shadow, vec3 position)
{
    if (osgsv_maskSize.x == 0)
        return 1.0;
    int index = int(shadow);
#if OSGSV_SAMPLES > 1
    float visible = 0.0;
    float samples = 0.0;
    for (int s = 0; s < OSGSV_SAMPLES; ++s)
#ifdef OSGSV_SAMPLE_MASK
        if ((gl_SampleMaskIn[0] & (1 << s)) != 0)
#endif
        {
            visible += osgsv_sampleVisible(index, s);
            samples += 1.0;
        }
    return visible / max(samples, 1.0);
#else
    return osgsv_sampleVisible(index, 0);
#endif
}
