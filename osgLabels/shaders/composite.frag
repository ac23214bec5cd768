// The second pass: puts the labelled picture into the view. OSGLABELS_SAMPLES: of the targets.

#if OSGLABELS_SAMPLES > 1
uniform sampler2DMS osgLabels_color, osgLabels_depths, osgLabels_places, osgLabels_footprints;
uniform usampler2DMS osgLabels_identifiers;
uniform int osgLabels_sample;
#else
uniform sampler2D osgLabels_color, osgLabels_depths, osgLabels_places, osgLabels_footprints;
uniform usampler2D osgLabels_identifiers;
const int osgLabels_sample = 0;
#endif
uniform int osgLabels_flippedHeight; // where rows count from the top, else 0

layout(location = 0) out vec4 osgmr_out0;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    if (osgLabels_flippedHeight > 0)
        p.y = osgLabels_flippedHeight - 1 - p.y;
    uint id = texelFetch(osgLabels_identifiers, p, osgLabels_sample).r;
    if (id == 0xffffffffu) // nothing is drawn here
        discard;
    gl_FragDepth = texelFetch(osgLabels_depths, p, osgLabels_sample).r;
    vec4 color = texelFetch(osgLabels_color, p, osgLabels_sample);
    if (id != 0u)
    {
        vec2 place = texelFetch(osgLabels_places, p, osgLabels_sample).rg;
        if (place.x >= 0.0)
        {
            vec4 footprint = texelFetch(osgLabels_footprints, p, osgLabels_sample);
            color = osgLabels_over(color, osgLabels_textOf(id), place,
                                   mat2(footprint.xy, footprint.zw), osgLabels_styleOf(id));
        }
    }
    osgmr_out0 = color;
}
