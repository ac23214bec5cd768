// What becomes of a map label as a whole: by its anchor, by what is seen of 64 places on it, or, where its pixels
// are tested one by one, whether any is seen. It keeps its state for a second, while not much less or more is seen,
// and while neither the view nor what is seen of it changes. Needs occlusion.glsl.

flat in vec4 osgLabels_text;
flat in vec4 osgLabels_anchor; // the last one: seconds since it came
flat in uvec4 osgLabels_keys;  // the last one: see MapQuads

uniform sampler2D osgLabels_states; // of the last frame
uniform vec2 osgLabels_pad;
uniform ivec4 osgLabels_bounds;     // first and last pixel of the view
uniform int osgLabels_isMoving;     // the view
uniform vec2 osgLabels_time;        // now, how long a state stays

// Action, since when, what was seen, whether a change of the scene waits for the end of the second.
layout(location = 0) out vec4 osgmr_out0;

// Shares under which a label goes, from which on a new one is shown, and over which it comes.
#ifdef OSGLABELS_WHOLLY
const vec3 osgLabels_Seen = vec3(0.5, 0.5, 6.5) / 64.0;
#else
const vec3 osgLabels_Seen = vec3(0.4, 0.5, 0.6);
#endif

int osgLabels_at(vec2 place)
{
    ivec2 p = clamp(ivec2(floor(place)), osgLabels_bounds.xy, osgLabels_bounds.zw);
    return osgLabels_actionAt(p, osgLabels_anchor.z, osgLabels_keys.yz);
}

// Places by action; returns how many there are.
int osgLabels_count(inout int counts[5])
{
#ifdef OSGLABELS_ANCHORED
    ++counts[osgLabels_at(osgLabels_anchor.xy)];
    return 1;
#else
    int number = 0;
    vec2 size = (vec2(0.5 * osgLabels_text.w, 0.5) + osgLabels_pad) * osgLabels_text.z;
    for (int i = 0; i < 64; ++i)
    {
        vec2 place = osgLabels_text.xy + size * (vec2(i & 7, i >> 3) / 4.0 - 0.875);
        if (any(lessThan(place, vec2(osgLabels_bounds.xy))) ||
            any(greaterThan(place, vec2(osgLabels_bounds.zw + 1))))
            continue;
        ++counts[osgLabels_at(place)];
        ++number;
    }
    return number;
#endif
}

void main()
{
    int row = textureSize(osgLabels_states, 0).x;
    int last = int(osgLabels_keys.w >> 8u) - 1;
    vec4 old = last < 0 ? vec4(0.0) : texelFetch(osgLabels_states, ivec2(last % row, last / row), 0);
    osgmr_out0 = old;
    if ((osgLabels_keys.w & 64u) != 0u)
        return; // out of view
    int counts[5] = int[5](0, 0, 0, 0, 0);
    int number = osgLabels_count(counts);
#ifdef OSGLABELS_WHOLLY
    counts = int[5](counts[0], 0, 0, 0, number - counts[0]);
#endif
    float seen = number > 0 ? float(counts[osgLabels_Ignore]) / float(number) : 1.0;
    int most = osgLabels_Hide;
    for (int i = osgLabels_Outline; i < osgLabels_Ignore; ++i)
        most = counts[i] > counts[most] ? i : most;
    float sight = float(8 * counts[osgLabels_Ignore] + most);
    if (last < 0)
    {
        int first = seen >= osgLabels_Seen.y ? osgLabels_Ignore : most;
        osgmr_out0 = vec4(float(first), osgLabels_time.x - osgLabels_time.y, sight, 0.0);
        return;
    }
    int was = int(old.r + 0.5);
    bool isSeen = was == osgLabels_Ignore ? seen >= osgLabels_Seen.x : seen > osgLabels_Seen.z;
    int action = isSeen ? osgLabels_Ignore : counts[most] > 0 ? most : was;
    bool isHeld = osgLabels_time.x - old.g < osgLabels_time.y ||
                  (osgLabels_anchor.w >= 0.0 && osgLabels_anchor.w < osgLabels_time.y);
    // A hidden label comes after decluttering has learnt of it, so that it doesn't take it away later.
    isHeld = isHeld || (was == osgLabels_Hide && osgLabels_anchor.w >= 0.0 && osgLabels_isMoving != 0);
    // Where all rests what was held back is dropped, so that nothing changes any more.
    bool isNew = osgLabels_isMoving == 0 && (sight != old.b || old.a > 0.5);
    bool changes = action != was && !isHeld && (osgLabels_isMoving != 0 || isNew);
    osgmr_out0 = vec4(float(changes ? action : was), changes ? osgLabels_time.x : old.g, sight,
                      float(isNew && isHeld && action != was));
}
