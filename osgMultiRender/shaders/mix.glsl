// How much each rendering counts in a fragment, by the distance to the nearest key point or
// segment. The layout is that of MixTexels; the reference in double precision is KeyPoints and
// MixWeights. One program serves any number of key points and all modes, ranges and rules.
//
//     osgmr_mixAt(eyePosition);
//     vec4 sum = vec4(0.0);
//     if (osgmr_weight(0) > 0.0) sum += osgmr_weight(0) * vec4(colour of rendering 0, 1.0);
//     ...
//     gl_FragColor = osgmr_mixed(sum);

uniform samplerBuffer osgmr_mix;
uniform mat3 osgmr_mixFrame; // from eye space to the key points'; both have the eye at 0
uniform ivec4 osgmr_mixKeys; // texel of the tree's root or 0; of the first segment; their number;
                             // texels a segment: 1 for points, 2 for lines
uniform ivec4 osgmr_mixRules; // number of renderings; base or -1; whether to normalise
uniform vec4 osgmr_mixBackground;

const float osgmr_noDistance = 1e30; // no key points, or a position that is not a number
const int osgmr_mixLeafSize = 4;
const int osgmr_mixStack = 32;

float osgmr_mixScale = 1.0;
float osgmr_mixMissing = 0.0;
float osgmr_mixDistance = osgmr_noDistance;

// Squared distance to a segment.
float osgmr_segment(int texel, vec3 at)
{
    vec4 place = texelFetch(osgmr_mix, texel);
    vec3 away = at - place.xyz;
    if (osgmr_mixKeys.w > 1)
    {
        vec4 line = texelFetch(osgmr_mix, texel + 1); // unit direction; place.w and w are its ends
        away -= clamp(dot(away, line.xyz), place.w, line.w) * line.xyz;
    }
    return dot(away, away);
}

float osgmr_nearestOf(int texel, int count, vec3 at, float nearest)
{
    for (int i = 0; i < count; ++i)
    {
        float square = osgmr_segment(texel, at);
        if (square < nearest) // never for what is not a number
            nearest = square;
        texel += osgmr_mixKeys.w;
    }
    return nearest;
}

// Squared distances to the boxes of a node's four children.
vec4 osgmr_boxes(int node, vec3 at)
{
    vec4 x = max(max(texelFetch(osgmr_mix, node + 1) - at.x, at.x - texelFetch(osgmr_mix, node + 2)), 0.0);
    vec4 y = max(max(texelFetch(osgmr_mix, node + 3) - at.y, at.y - texelFetch(osgmr_mix, node + 4)), 0.0);
    vec4 z = max(max(texelFetch(osgmr_mix, node + 5) - at.z, at.z - texelFetch(osgmr_mix, node + 6)), 0.0);
    return x * x + y * y + z * z;
}

// The child with the nearest box is entered at once, the others wait with their distances.
float osgmr_nearestInTree(vec3 at, float nearest)
{
    vec2 waiting[osgmr_mixStack]; // squared distance, address
    int depth = 0;
    float address = float(osgmr_mixKeys.x);
    for (;;)
    {
        while (address > 0.0)
        {
            vec4 children = texelFetch(osgmr_mix, int(address));
            vec4 squares = osgmr_boxes(int(address), at);
            address = 0.0;
            float best = nearest;
            for (int i = 0; i < 4; ++i)
            {
                if (children[i] == 0.0 || !(squares[i] < nearest))
                    continue;
                if (squares[i] < best)
                {
                    if (address != 0.0)
                        waiting[depth++] = vec2(best, address);
                    best = squares[i];
                    address = children[i];
                }
                else
                    waiting[depth++] = vec2(squares[i], children[i]);
            }
        }
        if (address < 0.0)
        {
            int leaf = int(-1.0 - address);
            nearest = osgmr_nearestOf(osgmr_mixKeys.y + leaf / osgmr_mixLeafSize * osgmr_mixKeys.w,
                                      leaf % osgmr_mixLeafSize + 1, at, nearest);
        }
        address = 0.0;
        while (depth > 0 && address == 0.0)
        {
            vec2 entry = waiting[--depth];
            if (entry.x < nearest)
                address = entry.y;
        }
        if (address == 0.0)
            return nearest;
    }
}

// From a position in eye space, in units of the key points.
float osgmr_distance(vec3 eyePosition)
{
    vec3 at = osgmr_mixFrame * eyePosition;
    const float none = 3e38;
    float nearest = osgmr_mixKeys.x > 0
                        ? osgmr_nearestInTree(at, none)
                        : osgmr_nearestOf(osgmr_mixKeys.y, osgmr_mixKeys.z, at, none);
    return nearest < none ? sqrt(nearest) : osgmr_noDistance;
}

// Of one rendering alone, before the rules.
float osgmr_rangeWeight(int rendering, float distance)
{
    vec4 range = texelFetch(osgmr_mix, 1 + rendering);
    if (distance < range.y)
        return distance > range.x ? (distance - range.x) / (range.y - range.x) : 0.0;
    if (distance > range.z)
        return distance < range.w ? (range.w - distance) / (range.w - range.z) : 0.0;
    return 1.0;
}

// To be called first, once a fragment: all else is of that position.
void osgmr_mixAt(vec3 eyePosition)
{
    osgmr_mixDistance = osgmr_distance(eyePosition);
    float sum = 0.0;
    for (int i = 0; i < osgmr_mixRules.x; ++i)
        sum += osgmr_rangeWeight(i, osgmr_mixDistance);
    osgmr_mixScale = osgmr_mixRules.z != 0 && sum > 1.0 ? 1.0 / sum : 1.0;
    osgmr_mixMissing = max(0.0, 1.0 - sum);
}

// Of a rendering, by the rules.
float osgmr_weight(int rendering)
{
    return osgmr_rangeWeight(rendering, osgmr_mixDistance) * osgmr_mixScale +
           (rendering == osgmr_mixRules.y ? osgmr_mixMissing : 0.0);
}

// The fragment's colour from the sum of weight * vec4(colour, 1.0).
vec4 osgmr_mixed(vec4 sum)
{
    float background = osgmr_mixRules.y < 0 ? osgmr_mixMissing * osgmr_mixBackground.a : 0.0;
    return clamp(sum + background * vec4(osgmr_mixBackground.rgb, 1.0), 0.0, 1.0);
}
