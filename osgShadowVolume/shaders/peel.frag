// The nearest surface that is behind the last layer and in front of all opaque ones. Without
// OSGSV_PEEL, depths alone.
#ifdef OSGSV_PEEL
#if OSGSV_SAMPLES > 1
uniform sampler2DMS osgsv_depth;       // of the last layer
uniform sampler2DMS osgsv_opaqueDepth;
#define OSGSV_DEPTH(image) texelFetch(image, osgsv_texel(), gl_SampleID).r
#else
uniform sampler2D osgsv_depth;
uniform sampler2D osgsv_opaqueDepth;
#define OSGSV_DEPTH(image) texelFetch(image, osgsv_texel(), 0).r
#endif
uniform int osgsv_layer;
layout(location = 0) out vec4 osgsv_layerDepth;
uniform int osgsv_flippedHeight; // where rows count from the top, else 0

ivec2 osgsv_texel()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    return osgsv_flippedHeight > 0 ? ivec2(texel.x, osgsv_flippedHeight - 1 - texel.y) : texel;
}

void main()
{
    float z = gl_FragCoord.z;
    if (osgsv_layer > 0 && z <= OSGSV_DEPTH(osgsv_depth))
        discard;
    if (z > OSGSV_DEPTH(osgsv_opaqueDepth)) // at the same depth it may be drawn over it
        discard;
    osgsv_layerDepth = vec4(z);
}
#else
void main() {}
#endif
