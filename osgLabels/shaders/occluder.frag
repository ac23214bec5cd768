// What may stand before map labels: number of the feature, and how far away: along the view, or window depth
// where rays are parallel.

layout(location = 1) out uvec2 osgLabels_outOccluder;

uniform int osgLabels_feature;
uniform int osgLabels_isParallel;
#ifdef OSGLABELS_NEXT
// Of the layer before: what it has is left out.
uniform usampler2DArray osgLabels_nearest;
uniform int osgLabels_layer0;
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
