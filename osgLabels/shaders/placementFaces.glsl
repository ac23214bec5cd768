// Where text lies on a recognised shape: a point of the surface becomes a point on a text.
//
// A shape's surface is unrolled into lines of text without stretching it: faces as they are,
// cylinders, cones and bands around spheres and dishes as sectors of a plane. On a line the text is
// repeated as often as it fits. What must not change within a label (which way is up, how tall, how
// often) follows from the shape and the view alone, never from the pixel.
//
// Placement.cpp compiles this file as C++, so it keeps to what GLSL and GLM share.

struct osgLabels_Object
{
    vec4 rotation; // Quaternion, local coordinates to the shape's frame.
    vec3 origin;   // Of the frame, in local coordinates.
    uint shape;    // Number, flags from bit 8.
    vec3 size;
    uint id;
};

// The view in the object's local coordinates.
struct osgLabels_View
{
    vec4 eye;         // Relative to the object's origin; w = 0: the direction to the viewer.
    vec3 up;          // Of the world; 0 where it has none.
    vec3 screenUp;    // The directions that are up and right on the screen.
    vec3 screenRight;
    float height;     // Of text, as a share of the room across its line.
    float gap;        // Least gap between repetitions, in em.
    vec3 base;        // What positions are given from, relative to the object's origin: the same
                      // for all of an object. Near the eye, it keeps text on the longest of pipes
                      // exact there; 0 for others.
};

struct osgLabels_Place
{
    bool inside;    // Whether the point is on a text.
    vec2 place;     // In em, x from the text's start, y from its line's bottom.
    mat2 footprint; // Columns: what the place changes by a pixel to the right and up.
    vec3 onLine[3]; // Points on the text's line, the same for all of a text: a sixth of the way,
                    // half and five sixths. As positions; from osgLabels_locate() on as pixels.
};

// A point by a line of text, in lengths of the shape's frame.
struct osgLabels_Line
{
    vec2 at;        // From the middle of the nearest text: along the line, across it.
    vec3 along;     // Gradients of the two.
    vec3 across;
    vec3 middle;    // A point of the line.
    vec3 direction; // Of the line there.
    float em;
    float beyond;   // Positive where the line's room has ended.
    vec3 axis;      // Of a line that runs around one through the frame's origin.
    vec2 bend;      // Of such a line its radius and the slope of the cone on which it is straight
                    // when unrolled; 0 for a straight line.
};

// The share of its room that a text may fill along the line.
const float osgLabels_Fill = 0.9f;
// What is more times as long as wide has its text along it, however short that is.
const float osgLabels_Long = 3.003f;
const float osgLabels_HalfPi = 1.57079633f;
const float osgLabels_TwoPi = 6.28318531f;
const float osgLabels_Tiny = 1e-30f;

float osgLabels_em(osgLabels_View view, float room, float across, float width)
{
    return min(view.height * across, osgLabels_Fill * room / width);
}

// How often a text of that many em is repeated in a room. Where it fits exactly, as with sides of
// simple ratios, rounding does not decide.
float osgLabels_count(osgLabels_View view, float room, float em, float width)
{
    return max(1.0f, floor(room / max((width + view.gap) * em, osgLabels_Tiny) + 1e-3f));
}

// The distance between the middles of texts, a little rounded down to 12 bits: then the first few
// million multiples of it are exact in floats, or nearly.
float osgLabels_period(float room, float count)
{
    return uintBitsToFloat(floatBitsToUint(room / count) & 0xfffff000u);
}

// From the middle of the nearest text to base + x, where 0 is in the middle of all.
float osgLabels_fromMiddle(float base, float x, float count, float period)
{
    float odd = count - 2.0f * floor(0.5f * count);
    float many = 4096.0f * period;
    float start = base - many * floor(base / many);
    start -= period * floor(start / period);
    float y = x + start + 0.5f * odd * period;
    return y - period * floor(y / period) - 0.5f * period;
}

// The direction in a face that reads as horizontal.
vec3 osgLabels_level(osgLabels_View view, vec3 normal, vec3 middle)
{
    vec3 level = cross(view.up, normal);
    if (dot(level, level) > 0.1f * dot(view.up, view.up))
        return level;
    return cross(view.screenUp, vec3(view.eye) - view.eye.w * middle);
}

// From a point q to the point of its line that lies s after the middle of the nearest text.
vec3 osgLabels_toLine(osgLabels_Line line, vec3 q, float s)
{
    vec3 d = line.middle - q;
    float radius = line.bend.x;
    float slope = line.bend.y;
    if (radius == 0.0f)
        return d + (s - line.at.x - dot(d, line.direction)) * line.direction;
    float turned = s / radius;
    float up = 0.0f;
    if (abs(slope) > 1e-5f)
    {
        turned = atan(s * slope / radius) / slope;
        up = (length(vec2(radius, s * slope)) - radius) / slope;
    }
    vec3 outward = line.middle - dot(line.middle, line.axis) * line.axis;
    vec3 ahead = cos(turned) * outward + sin(turned) * cross(line.axis, outward);
    vec3 generator = slope / radius * ahead + sqrt(max(1.0f - slope * slope, 0.0f)) * line.axis;
    return d - outward + ahead + up * generator;
}

// A rectangle with its middle, unit axes and half sides, of which text may use a share.
osgLabels_Line osgLabels_face(osgLabels_View view, vec3 p, vec3 middle, vec3 a, vec3 b, vec2 side,
                              float share, float width)
{
    osgLabels_Line line;
    // What is long keeps its length: what is amiss there is so across it, as with profiles.
    bool isLongA = side.x > osgLabels_Long * side.y;
    bool isLongB = side.y > osgLabels_Long * side.x;
    side *= vec2(isLongA && share > 0.0f ? 1.0f : share, isLongB && share > 0.0f ? 1.0f : share);
    float emA = osgLabels_em(view, 2.0f * side.x, 2.0f * side.y, width);
    float emB = osgLabels_em(view, 2.0f * side.y, 2.0f * side.x, width);
    // Along the long side; but horizontal text may be smaller by a third, unless it would stand
    // across what is long. Equal ones are told apart by a margin, or rounding would.
    vec3 level = osgLabels_level(view, cross(a, b), middle);
    float levelA = abs(dot(level, a));
    float levelB = abs(dot(level, b));
    float sum = max(levelA + levelB, osgLabels_Tiny);
    bool alongA = 1.002f * emA * (1.0f + 0.5f * levelA / sum) > emB * (1.0f + 0.5f * levelB / sum);
    alongA = isLongA || (alongA && !isLongB);
    line.along = alongA ? a : b;
    line.across = alongA ? b : a;
    line.em = alongA ? emA : emB;
    line.middle = middle;
    line.direction = line.along;
    float room = 2.0f * (alongA ? side.x : side.y);
    float count = osgLabels_count(view, room, line.em, width);
    line.at = vec2(osgLabels_fromMiddle(dot(view.base, line.along), dot(p, line.along), count,
                                        osgLabels_period(room, count)),
                   dot(p + view.base - middle, line.across));
    line.beyond = share < 1.0f && !(alongA ? isLongA : isLongB) ? abs(dot(p + view.base, line.along)) - 0.5f * room : 0.0f;
    line.axis = vec3(0.0f);
    line.bend = vec2(0.0f);
    return line;
}

// A disc around the z axis: one text.
osgLabels_Line osgLabels_disc(osgLabels_View view, vec3 p, float z, float radius, float width)
{
    osgLabels_Line line;
    vec3 normal = vec3(0.0f, 0.0f, 1.0f);
    line.middle = vec3(0.0f, 0.0f, z);
    vec3 level = osgLabels_level(view, normal, line.middle);
    vec3 x = vec3(1.0f, 0.0f, 0.0f);
    vec3 y = vec3(0.0f, 1.0f, 0.0f);
    // Lying discs have text along an axis of the frame, so that it does not turn with the camera.
    vec3 axis = 1.002f * abs(level.x) > abs(level.y) ? x : y;
    bool lies = abs(view.up.z) > 0.94f * length(view.up);
    float size = length(vec2(level.x, level.y));
    line.along = lies || size < osgLabels_Tiny ? axis : vec3(level.x, level.y, 0.0f) / size;
    line.across = cross(normal, line.along);
    line.direction = line.along;
    line.em = min(view.height * radius,
                  2.0f * osgLabels_Fill * radius * inversesqrt(1.0f + width * width));
    vec3 q = p + view.base;
    line.at = vec2(dot(q, line.along), dot(q, line.across));
    line.beyond = 0.0f;
    line.axis = vec3(0.0f);
    line.bend = vec2(0.0f);
    return line;
}

float osgLabels_share(uint room)
{
    return 1.0f - float(room & 15u) / 15.0f;
}

// The face of a box that the normal (largest component 1) points out of.
// `rooms`: 4 bits each for x, y and z, see ObjectRecord.h.
osgLabels_Line osgLabels_box(osgLabels_View view, vec3 p, vec3 normal, vec3 size, uint rooms,
                             float width)
{
    vec3 x = vec3(1.0f, 0.0f, 0.0f);
    vec3 y = vec3(0.0f, 1.0f, 0.0f);
    vec3 z = vec3(0.0f, 0.0f, 1.0f);
    vec3 n = abs(normal);
    vec3 q = p + view.base;
    if (n.z >= max(n.x, n.y))
        return osgLabels_face(view, p, vec3(0.0f, 0.0f, q.z < 0.0f ? -size.z : size.z), x, y,
                              vec2(size.x, size.y), osgLabels_share(rooms >> 8u), width);
    if (n.y >= n.x)
        return osgLabels_face(view, p, vec3(0.0f, q.y < 0.0f ? -size.y : size.y, 0.0f), z, x,
                              vec2(size.z, size.x), osgLabels_share(rooms >> 4u), width);
    return osgLabels_face(view, p, vec3(q.x < 0.0f ? -size.x : size.x, 0.0f, 0.0f), y, z,
                          vec2(size.y, size.z), osgLabels_share(rooms), width);
}

// A side's text lies above its base line, a part of the way up.
osgLabels_Line osgLabels_pyramid(osgLabels_View view, vec3 p, float flatness, vec3 size,
                                 float width)
{
    p += view.base;
    view.base = vec3(0.0f);
    bool sideX = abs(p.x) * size.y > abs(p.y) * size.x;
    vec3 outward = sideX ? vec3(p.x < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f)
                      : vec3(0.0f, p.y < 0.0f ? -1.0f : 1.0f, 0.0f);
    float reach = sideX ? size.x : size.y;
    float side = sideX ? size.y : size.x;
    float slant = max(length(vec2(reach, 2.0f * size.z)), osgLabels_Tiny);
    float widest = max(size.x, size.y) /
                   max(length(vec2(max(size.x, size.y), 2.0f * size.z)), osgLabels_Tiny);
    if (flatness > 0.5f + 0.5f * widest)
        return osgLabels_face(view, p, vec3(0.0f, 0.0f, -size.z), vec3(1.0f, 0.0f, 0.0f),
                              vec3(0.0f, 1.0f, 0.0f), vec2(size), 1.0f, width);
    osgLabels_Line line;
    line.along = cross(vec3(0.0f, 0.0f, 1.0f), outward);
    line.across = (vec3(0.0f, 0.0f, 2.0f * size.z) - reach * outward) / slant;
    float bottom = 0.1f * slant;
    // As tall as the triangle lets a text be that fills its width at the text's top.
    float taper = 2.0f * osgLabels_Fill * side / slant;
    line.em = min(0.5f * view.height * slant, taper * (slant - bottom) / (width + taper));
    vec3 foot = reach * outward - vec3(0.0f, 0.0f, size.z);
    line.middle = foot + (bottom + 0.5f * line.em) * line.across;
    line.direction = line.along;
    float room = 2.0f * side * (1.0f - (bottom + line.em) / slant);
    float count = osgLabels_count(view, room, line.em, width);
    vec3 q = p - line.middle;
    float x = dot(q, line.along);
    line.at = vec2(osgLabels_fromMiddle(0.0f, x, count, room / count), dot(q, line.across));
    line.beyond = abs(x) - 0.5f * room;
    line.axis = vec3(0.0f);
    line.bend = vec2(0.0f);
    return line;
}
