// What may stand before map labels: number of the feature, and how far away: along the view, or window depth
// where rays are parallel. OSGLABELS_RECORDS: a drawable holds many objects.

layout(location = 1) out uvec2 osgLabels_outOccluder;

uniform int osgLabels_isByDepth;
#ifdef OSGLABELS_NEXT
// Of the layer before: what it has is left out.
uniform usampler2DArray osgLabels_nearest;
uniform int osgLabels_layer0;
#endif
#ifdef OSGLABELS_PAGED
#define osgLabels_Words usampler2DArray
#else
#define osgLabels_Words usamplerBuffer
#endif
#if defined(OSGLABELS_NESTED) || defined(OSGLABELS_RECORDS)
uint osgLabels_word(osgLabels_Words words, int index)
{
#ifdef OSGLABELS_PAGED
    return texelFetch(words, ivec3(index & 1023, index >> 10 & 1023, index >> 20), 0).r;
#else
    return texelFetch(words, index).r;
#endif
}
#endif
#ifdef OSGLABELS_NESTED
// By number, first and last one of the feature of a certain depth around it: all of that is left out.
uniform osgLabels_Words osgLabels_nests;
uniform ivec2 osgLabels_nestAt; // of number 0, how many numbers
#endif

#ifdef OSGLABELS_RECORDS
uniform osgLabels_Words osgLabels_features;
uniform ivec2 osgLabels_action; // of the layer; of objects without a class

uint osgLabels_featureOf(int index)
{
    uint word = osgLabels_word(osgLabels_features, index);
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
    uint nearest = texelFetch(osgLabels_nearest, ivec3(ivec2(gl_FragCoord.xy), osgLabels_layer0), 0).r;
    uint last = nearest;
#ifdef OSGLABELS_NESTED
    int at = osgLabels_nestAt.x + 2 * int(nearest);
    if (int(nearest) < osgLabels_nestAt.y)
    {
        last = osgLabels_word(osgLabels_nests, at + 1);
        nearest = osgLabels_word(osgLabels_nests, at);
    }
#endif
    if (number >= nearest && number <= last)
        discard;
#endif
    float distance = osgLabels_isByDepth != 0 ? gl_FragCoord.z : 1.0 / gl_FragCoord.w;
    osgLabels_outOccluder = uvec2(number, floatBitsToUint(distance));
}
