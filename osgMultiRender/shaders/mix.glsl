// How much each rendering counts in a fragment, by the distance to the nearest key point or
// segment. The layout is that of MixTexels; the reference in double precision is KeyPoints and
// MixWeights. One program serves any number of key points and all modes, ranges and rules.
//
//     osgmr_mixAt(eyePosition);
//     vec4 sum = vec4(0.0);
//     if (osgmr_weight(0) > 0.0) sum += osgmr_weight(0) * vec4(colour of rendering 0, 1.0);
//     ...
//     gl_FragColor = osgmr_mixed(sum);

uniform usamplerBuffer osgmr_mix;
uniform mat3 osgmr_mixFrame; // from eye space to the key points'; both have the eye at 0
uniform ivec4 osgmr_mixKeys; // texel of the tree's root or 0; of the first segment; their number;
                             // texels a segment: 1 for points, 2 for lines
uniform ivec4 osgmr_mixRules; // number of renderings; base or -1; whether to normalise
uniform vec4 osgmr_mixBackground;
uniform vec4 osgmr_mixRoots[2]; // low corners of the cells' grids; 1 / their sizes
uniform ivec4 osgmr_mixCells;   // texel of the cells or 0; the first cells of both grids
uniform ivec4 osgmr_mixListed;  // texel of the segments that cells list; of those that none lists;
                                // the number of these

const float osgmr_noDistance = 1e30; // no key points, or a position that is not a number
const int osgmr_mixLeafSize = 4;
const int osgmr_mixStack = 32;

float osgmr_mixScale = 1.0;
float osgmr_mixMissing = 0.0;
float osgmr_mixDistance = osgmr_noDistance;

vec4 osgmr_mixFloats(int texel)
{
    return uintBitsToFloat(texelFetch(osgmr_mix, texel));
}

vec4 osgmr_mixBytes(uint word)
{
    return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 255u);
}

float osgmr_squareToLine(int texel, vec3 at)
{
    vec4 place = osgmr_mixFloats(texel);
    vec4 line = osgmr_mixFloats(texel + 1); // unit direction; place.w and w are its ends
    vec3 away = at - place.xyz;
    away -= clamp(dot(away, line.xyz), place.w, line.w) * line.xyz;
    return dot(away, away);
}

float osgmr_squareToPoint(int texel, vec3 at)
{
    vec3 away = at - osgmr_mixFloats(texel).xyz;
    return dot(away, away);
}

// The least squared distance to segments. One loop for points and one for lines: what is decided
// within a loop is paid for each segment.
float osgmr_nearestOf(int texel, int count, vec3 at, float nearest)
{
    if (osgmr_mixKeys.w > 1)
        for (int i = 0; i < count; ++i)
        {
            float square = osgmr_squareToLine(texel, at);
            nearest = square < nearest ? square : nearest; // never for what is not a number
            texel += 2;
        }
    else
        for (int i = 0; i < count; ++i)
        {
            float square = osgmr_squareToPoint(texel + i, at);
            nearest = square < nearest ? square : nearest;
        }
    return nearest;
}

// How far a coordinate is outside of four intervals.
vec4 osgmr_outside(uint lows, uint highs, float unit, float at)
{
    return max(max(unit * osgmr_mixBytes(lows) - at, at - unit * osgmr_mixBytes(highs)), 0.0);
}

// Squared distances to the boxes of a node's four children: bytes times a power of two.
vec4 osgmr_boxes(int node, vec3 at)
{
    uvec4 origin = texelFetch(osgmr_mix, node);
    uvec4 words = texelFetch(osgmr_mix, node + 1);
    uvec4 others = texelFetch(osgmr_mix, node + 2);
    vec3 from = at - uintBitsToFloat(origin.xyz);
    vec3 unit = uintBitsToFloat((uvec3(origin.w, origin.w >> 8, origin.w >> 16) & 255u) << 23);
    vec4 x = osgmr_outside(words.x, words.w, unit.x, from.x);
    vec4 y = osgmr_outside(words.y, others.x, unit.y, from.y);
    vec4 z = osgmr_outside(words.z, others.y, unit.z, from.z);
    return x * x + y * y + z * z;
}

// The child with the nearest box is entered at once, the others wait with their distances. Down to
// a leaf without branches, so that neighbouring fragments stay together.
float osgmr_nearestInTree(vec3 at, float nearest)
{
    float waitingSquares[osgmr_mixStack];
    int waiting[osgmr_mixStack];
    int depth = 0;
    int address = osgmr_mixKeys.x;
    for (;;)
    {
        while (address > 0)
        {
            ivec4 children = ivec4(texelFetch(osgmr_mix, address + 3));
            vec4 squares = osgmr_boxes(address, at);
            address = 0;
            float best = nearest;
            for (int i = 0; i < 4; ++i)
            {
                bool enters = children[i] != 0 && squares[i] < nearest;
                bool isNearest = enters && squares[i] < best;
                waitingSquares[depth] = isNearest ? best : squares[i];
                waiting[depth] = isNearest ? address : children[i];
                depth += int(enters && (address != 0 || !isNearest));
                best = isNearest ? squares[i] : best;
                address = isNearest ? children[i] : address;
            }
        }
        if (address < 0)
        {
            int leaf = -1 - address;
            nearest = osgmr_nearestOf(osgmr_mixKeys.y + leaf / osgmr_mixLeafSize * osgmr_mixKeys.w,
                                      leaf % osgmr_mixLeafSize + 1, at, nearest);
        }
        address = 0;
        while (depth > 0 && address == 0)
            if (waitingSquares[--depth] < nearest)
                address = waiting[depth];
        if (address == 0)
            return nearest;
    }
}

// Segments in texels of four indices, the last one included. The position is a number here.
float osgmr_nearestInList(int first, int last, vec3 at)
{
    float nearest = 3e38;
    if (osgmr_mixKeys.w > 1)
        for (int i = first; i <= last; ++i)
        {
            ivec4 four = osgmr_mixListed.x + 2 * ivec4(texelFetch(osgmr_mix, i));
            nearest = min(nearest, min(osgmr_squareToLine(four.x, at), osgmr_squareToLine(four.y, at)));
            nearest = min(nearest, min(osgmr_squareToLine(four.z, at), osgmr_squareToLine(four.w, at)));
        }
    else
        for (int i = first; i <= last; ++i)
        {
            ivec4 four = osgmr_mixListed.x + ivec4(texelFetch(osgmr_mix, i));
            nearest = min(nearest, min(osgmr_squareToPoint(four.x, at), osgmr_squareToPoint(four.y, at)));
            nearest = min(nearest, min(osgmr_squareToPoint(four.z, at), osgmr_squareToPoint(four.w, at)));
        }
    return nearest;
}

int osgmr_cell(int index)
{
    return int(texelFetch(osgmr_mix, osgmr_mixCells.x + (index >> 2))[index & 3]);
}

// To the segments that the cell of the position lists: see KeyCells. Less than 0 where none does.
float osgmr_nearestInCell(vec3 at)
{
    int cell = 0;
    ivec3 place = ivec3(0);
    for (int i = 1; i >= 0; --i)
    {
        vec3 share = (at - osgmr_mixRoots[i].xyz) * osgmr_mixRoots[i].w;
        if (all(greaterThanEqual(share, vec3(0.0))) && all(lessThan(share, vec3(1.0))))
        {
            place = ivec3(share * 65536.0);
            ivec3 coarse = place >> 12;
            cell = osgmr_mixCells[1 + i] + (coarse.z * 16 + coarse.y) * 16 + coarse.x;
        }
    }
    if (cell == 0)
        return -1.0;
    cell = osgmr_cell(cell);
    for (int shift = 11; cell > 0; --shift)
    {
        ivec3 part = (place >> shift) & 1;
        cell = osgmr_cell(cell + part.x + 2 * part.y + 4 * part.z);
    }
    if (cell == 0)
        return -1.0;
    int list = osgmr_mixCells.x + ((-1 - cell) >> 4);
    float nearest = osgmr_nearestInList(list, list + ((-1 - cell) & 15), at);
    return osgmr_nearestOf(osgmr_mixListed.y, osgmr_mixListed.z, at, nearest);
}

// From a position in eye space, in units of the key points.
float osgmr_distance(vec3 eyePosition)
{
    vec3 at = osgmr_mixFrame * eyePosition;
    const float none = 3e38;
    float nearest = osgmr_mixCells.x > 0 ? osgmr_nearestInCell(at) : -1.0;
    if (nearest < 0.0)
        nearest = osgmr_mixKeys.x > 0
                        ? osgmr_nearestInTree(at, none)
                        : osgmr_nearestOf(osgmr_mixKeys.y, osgmr_mixKeys.z, at, none);
    return nearest < none ? sqrt(nearest) : osgmr_noDistance;
}

// Of one rendering alone, before the rules.
float osgmr_rangeWeight(int rendering, float distance)
{
    vec4 range = osgmr_mixFloats(1 + rendering);
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
