// What may stand before map labels: number of the feature, and how far away: along the view, or window depth
// where rays are parallel. OSGLABELS_RECORDS: a drawable holds many objects.

layout(location = 1) out uvec2 osgLabels_outOccluder;

uniform int osgLabels_isParallel;
#ifdef OSGLABELS_NEXT
// Of the layer before: what it has is left out.
uniform usampler2DArray osgLabels_nearest;
uniform int osgLabels_layer0;
#endif

#ifdef OSGLABELS_RECORDS
#ifdef OSGLABELS_PAGED
uniform usampler2DArray osgLabels_features;
#else
uniform usamplerBuffer osgLabels_features;
#endif
uniform ivec2 osgLabels_action; // of the layer; of objects without a class

uint osgLabels_featureOf(int index)
{
#ifdef OSGLABELS_PAGED
    uint word = texelFetch(osgLabels_features, ivec3(index & 1023, index >> 10 & 1023, index >> 20), 0).r;
#else
    uint word = texelFetch(osgLabels_features, index).r;
#endif
    int action = int(word >> 2u & 7u), sides = int(word & 3u);
    // Of a closed mesh only faces that a ray leaves by count.
    bool isLeft = sides == 0 || gl_FrontFacing == (sides == 2);
    if ((action == 7 ? osgLabels_action.y : action) != osgLabels_action.x || !isLeft)
        discard;
    return word >> 5u;
}
#else
uniform int osgLabels_feature;
#endif

void osgLabels_writeOccluder(uint number)
{
#ifdef OSGLABELS_NEXT
    if (texelFetch(osgLabels_nearest, ivec3(ivec2(gl_FragCoord.xy), osgLabels_layer0), 0).r == number)
        discard;
#endif
    float distance = osgLabels_isParallel != 0 ? gl_FragCoord.z : 1.0 / gl_FragCoord.w;
    osgLabels_outOccluder = uvec2(number, floatBitsToUint(distance));
}
