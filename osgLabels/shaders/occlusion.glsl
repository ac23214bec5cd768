// What becomes of a place of a map label, by what stands before it. OSGLABELS_LAYERS: actions in use; 0: nothing
// stands anywhere. OSGLABELS_NEXT: there are layers with the nearest of another feature than the first.

const int osgLabels_Hide = 0, osgLabels_Outline = 1, osgLabels_Recolor = 2, osgLabels_Fade = 3, osgLabels_Ignore = 4;

#if OSGLABELS_LAYERS > 0
uniform usampler2DArray osgLabels_nearFace; // number, distance
#ifdef OSGLABELS_NEXT
uniform usampler2DArray osgLabels_next;
#endif
uniform ivec4 osgLabels_actions; // of the layers, the strongest first
uniform int osgLabels_isByDepth;
uniform int osgLabels_isBack; // labels lie just before the backs of their own features

bool osgLabels_isOwn(uint number, uvec2 own) { return number >= own.x && number <= own.y; }

// Float rounding, of rasterizing too, and more.
float osgLabels_before(float distance)
{
    return osgLabels_isByDepth != 0 ? distance - 1e-6 : distance - 2e-6 * abs(distance);
}

// Of the layer `next`, 1 for the first of them.
uvec2 osgLabels_nextAt(ivec2 p, int layer, int next)
{
#ifdef OSGLABELS_NEXT
    return texelFetch(osgLabels_next, ivec3(p, (next - 1) * OSGLABELS_LAYERS + layer), 0).rg;
#else
    return uvec2(0u);
#endif
}

// `keys`: numbers of the own feature from, to; the latter with the layer that is behind it.
int osgLabels_actionAt(ivec2 p, float distance, uvec2 keys)
{
    uvec2 own = uvec2(keys.x, keys.y & 0x7ffffffu);
    int behind = int(keys.y >> 27u);
    uvec2 foreign[OSGLABELS_LAYERS];
    float back = -1.0;
    for (int i = 0; i < OSGLABELS_LAYERS; ++i)
    {
        uvec2 near = texelFetch(osgLabels_nearFace, ivec3(p, i), 0).rg, next = osgLabels_nextAt(p, i, behind);
        bool isNear = osgLabels_isOwn(near.x, own), isNext = osgLabels_isOwn(next.x, own);
        foreign[i] = isNear ? (isNext ? uvec2(0u) : next) : near;
        float found = isNear ? uintBitsToFloat(near.y) : isNext ? uintBitsToFloat(next.y) : -1.0;
        back = found >= 0.0 && (back < 0.0 || found < back) ? found : back;
    }
    if (osgLabels_isBack != 0 && back >= 0.0)
        distance = back;
    float limit = osgLabels_before(distance);
    for (int i = 0; i < OSGLABELS_LAYERS; ++i)
        if (foreign[i].x != 0u && uintBitsToFloat(foreign[i].y) < limit)
            return osgLabels_actions[i];
    return osgLabels_Ignore;
}
#else
int osgLabels_actionAt(ivec2 p, float distance, uvec2 keys) { return osgLabels_Ignore; }
#endif
