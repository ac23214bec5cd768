// What becomes of a map label as a whole: by its anchor, or by what is seen of 64 places on it. It keeps its state
// for a second, and while not much less or more than half is seen. Needs occlusion.glsl.

flat in vec4 osgLabels_text;
flat in vec4 osgLabels_anchor;
flat in uvec4 osgLabels_keys; // the last one: style, and from bit 8 on the index in the last frame plus 1

uniform sampler2D osgLabels_states; // of the last frame: action, since when
uniform vec2 osgLabels_pad;
uniform ivec4 osgLabels_bounds;     // first and last pixel of the view
uniform vec2 osgLabels_time;        // now, how long a state stays

layout(location = 0) out vec4 osgmr_out0;

const vec2 osgLabels_Seen = vec2(0.4, 0.6); // shares under which a label goes, and over which it comes

int osgLabels_at(vec2 place)
{
    ivec2 p = clamp(ivec2(floor(place)), osgLabels_bounds.xy, osgLabels_bounds.zw);
    return osgLabels_actionAt(p, osgLabels_anchor.z, osgLabels_keys.yz);
}

void main()
{
    int counts[5] = int[5](0, 0, 0, 0, 0);
    int number = 0;
#ifdef OSGLABELS_ANCHORED
    ++counts[osgLabels_at(osgLabels_anchor.xy)];
    number = 1;
#else
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
#endif
    float seen = number > 0 ? float(counts[osgLabels_Ignore]) / float(number) : 1.0;
    int most = osgLabels_Hide;
    for (int i = osgLabels_Outline; i < osgLabels_Ignore; ++i)
        most = counts[i] > counts[most] ? i : most;
    int index = int(osgLabels_keys.w >> 8u) - 1;
    int action = seen >= 0.5 ? osgLabels_Ignore : most;
    float since = osgLabels_time.x - osgLabels_time.y;
    if (index >= 0)
    {
        int row = textureSize(osgLabels_states, 0).x;
        vec4 old = texelFetch(osgLabels_states, ivec2(index % row, index / row), 0);
        int was = int(old.r + 0.5);
        bool isSeen = was == osgLabels_Ignore ? seen >= osgLabels_Seen.x : seen > osgLabels_Seen.y;
        action = isSeen ? osgLabels_Ignore : counts[most] > 0 ? most : was;
        bool stays = action == was || osgLabels_time.x - old.g < osgLabels_time.y;
        action = stays ? was : action;
        since = stays ? old.g : osgLabels_time.x;
    }
    osgmr_out0 = vec4(float(action), since, seen, 0.0);
}
