// SPDX-License-Identifier: MIT
// How much of a pixel a label's ink covers. GlyphCoverage is its twin in C++; what the images hold
// is told in GlyphImages.h. Needs labelTable.glsl.
uniform sampler2DArray osgLabels_boxes;
uniform sampler2DArray osgLabels_distances;
uniform vec4 osgLabels_levels[8];       // texels an em, offset in texels, margin in em
uniform vec4 osgLabels_distanceLevel;   // as a level
uniform vec2 osgLabels_imageWidths;     // texels: of boxes, of distances
uniform vec4 osgLabels_letters;         // cell in em, 0: each its own; overhang; images; mean ink
uniform vec2 osgLabels_legible;         // under x pixels an em ink fades, to y times its mean

const float osgLabels_Spread = 4.0 / 128.0; // em that 0 and 1 of a distance stand for
const vec2 osgLabels_Large = vec2(15.0, 18.0); // pixels an em between which distances take over
const float osgLabels_Slices = 2.5;         // of a square's side, along a long footprint
const float osgLabels_MostSlices = 32.0;

struct osgLabels_Cell
{
    int index;
    float left; // em
    float width;
};

// A square in em that stands for a pixel or a slice of one: its level, how its four turned images
// are mixed, and how far from a cell's side a neighbour's ink is still seen.
struct osgLabels_Square
{
    float side;
    float level;
    vec4 turn;
    float reach;
};

// Layer, and column of images within the layers: their number is a power of two.
ivec2 osgLabels_layerOf(uint image, int layers)
{
    return ivec2(image & uint(layers - 1), image / uint(layers));
}

uint osgLabels_imageOf(uint code, uint which) { return code * uint(osgLabels_letters.z) + which; }

float osgLabels_advanceOf(uint code)
{
    ivec2 layer = osgLabels_layerOf(osgLabels_imageOf(code, 0u), textureSize(osgLabels_boxes, 0).z);
    ivec3 texel = ivec3(layer.y * int(osgLabels_imageWidths.x), 0, layer.x);
    return dot(texelFetch(osgLabels_boxes, texel, 0), 255.0 * exp2(-vec4(0.0, 8.0, 16.0, 24.0)));
}

// Moves on or back to the cell that x lies in; before the first and after the last one the index
// is out of range.
void osgLabels_moveTo(inout osgLabels_Cell cell, osgLabels_Text text, float x)
{
    if (osgLabels_letters.x > 0.0)
    {
        float index = floor(x / osgLabels_letters.x);
        cell = osgLabels_Cell(int(index), index * osgLabels_letters.x, osgLabels_letters.x);
        return;
    }
    while (x < cell.left && cell.index >= 0)
    {
        cell.index -= 1;
        cell.width = cell.index < 0 ? 0.0 : osgLabels_advanceOf(osgLabels_code(text, cell.index));
        cell.left -= cell.width;
    }
    while (x >= cell.left + cell.width && cell.index < text.length)
    {
        cell.left += cell.width;
        cell.index += 1;
        cell.width = cell.index < text.length
                         ? osgLabels_advanceOf(osgLabels_code(text, cell.index)) : 0.0;
    }
}

osgLabels_Cell osgLabels_cellAt(osgLabels_Text text, float x)
{
    osgLabels_Cell cell = osgLabels_Cell(-1, 0.0, 0.0);
    osgLabels_moveTo(cell, text, x);
    return cell;
}

float osgLabels_width(osgLabels_Text text)
{
    if (osgLabels_letters.x > 0.0)
        return float(text.length) * osgLabels_letters.x;
    float width = 0.0;
    for (int i = 0; i < text.length; ++i)
        width += osgLabels_advanceOf(osgLabels_code(text, i));
    return width;
}

// Of a place in texels; `image` as osgLabels_layerOf() gives it.
vec3 osgLabels_coordinates(vec4 level, vec2 place, float width, ivec2 image, vec2 scale,
                           float imageWidth)
{
    place = clamp(place, vec2(-level.w), vec2(width, 1.0) + level.w);
    vec2 texel = place * level.x + level.yz;
    texel.x += float(image.y) * imageWidth;
    return vec3(texel * scale, float(image.x));
}

// Of one letter's ink in a square about a place in em from the left of its cell.
float osgLabels_letterInSquare(uint code, vec2 place, float width, osgLabels_Square square,
                               uint which)
{
    ivec3 size = textureSize(osgLabels_boxes, 0);
    vec2 scale = 1.0 / vec2(size.xy);
    ivec2 image = osgLabels_layerOf(osgLabels_imageOf(code, which), size.z);
    int coarse = int(square.level);
    vec3 low = osgLabels_coordinates(osgLabels_levels[coarse], place, width, image, scale,
                                     osgLabels_imageWidths.x);
    vec3 high = osgLabels_coordinates(osgLabels_levels[min(coarse + 1, 7)], place, width, image,
                                      scale, osgLabels_imageWidths.x);
    return dot(mix(textureLod(osgLabels_boxes, low, 0.0), textureLod(osgLabels_boxes, high, 0.0),
                   fract(square.level)), square.turn);
}

float osgLabels_letterAt(osgLabels_Text text, osgLabels_Cell cell, vec2 place,
                         osgLabels_Square square, uint which)
{
    if (cell.index < 0 || cell.index >= text.length)
        return 0.0;
    return osgLabels_letterInSquare(osgLabels_code(text, cell.index),
                                    place - vec2(cell.left, 0.0), cell.width, square, which);
}

osgLabels_Cell osgLabels_neighbour(osgLabels_Text text, osgLabels_Cell cell, int step)
{
    int index = cell.index + step;
    float width = osgLabels_letters.x;
    if (width == 0.0 && index >= 0 && index < text.length)
        width = osgLabels_advanceOf(osgLabels_code(text, index));
    return osgLabels_Cell(index, step > 0 ? cell.left + cell.width : cell.left - width, width);
}

// Of the ink in a square about a place of the label: the letter's there and its nearer neighbour's.
float osgLabels_inkInSquare(osgLabels_Text text, osgLabels_Cell cell, vec2 place,
                            osgLabels_Square square, uint which)
{
    float ink = osgLabels_letterAt(text, cell, place, square, which);
    float fromLeft = place.x - cell.left, fromRight = cell.left + cell.width - place.x;
    if (min(fromLeft, fromRight) < square.reach + osgLabels_letters.y)
        ink += osgLabels_letterAt(text,
                                  osgLabels_neighbour(text, cell, fromLeft < fromRight ? -1 : 1),
                                  place, square, which);
    return min(ink, 1.0);
}

// `along` twice the cosine and sine of four times the square's angle, of any length.
osgLabels_Square osgLabels_squareOf(float side, vec2 along, float reach)
{
    vec4 turn = max(vec4(along, -along), 0.0);
    return osgLabels_Square(side, clamp(-2.0 * log2(side) - 2.0, 0.0, 7.0),
                            turn / max(dot(turn, vec4(1.0)), 1e-30), reach);
}

// Twice the angle of a vector given by cosine and sine.
vec2 osgLabels_doubled(vec2 v) { return vec2(v.x * v.x - v.y * v.y, 2.0 * v.x * v.y); }

// Signed distance to the ink's border in em, positive inside.
float osgLabels_distanceAt(osgLabels_Text text, osgLabels_Cell cell, vec2 place, uint which)
{
    if (cell.index < 0 || cell.index >= text.length)
        return -osgLabels_Spread;
    ivec3 size = textureSize(osgLabels_distances, 0);
    ivec2 image = osgLabels_layerOf(osgLabels_imageOf(osgLabels_code(text, cell.index), which),
                                    size.z);
    vec3 at = osgLabels_coordinates(osgLabels_distanceLevel, place - vec2(cell.left, 0.0),
                                    cell.width, image, 1.0 / vec2(size.xy),
                                    osgLabels_imageWidths.y);
    return (textureLod(osgLabels_distances, at, 0.0).r * 2.0 - 1.0) * osgLabels_Spread;
}

float osgLabels_nearestInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place, uint which)
{
    osgLabels_moveTo(cell, text, place.x);
    float distance = osgLabels_distanceAt(text, cell, place, which);
    float fromLeft = place.x - cell.left, fromRight = cell.left + cell.width - place.x;
    if (min(fromLeft, fromRight) < osgLabels_letters.y) // ink that reaches over
        distance = max(distance,
                       osgLabels_distanceAt(text,
                                            osgLabels_neighbour(text, cell,
                                                                fromLeft < fromRight ? -1 : 1),
                                            place, which));
    return distance;
}

// Large letters: a quarter of the pixel at a time.
float osgLabels_largeInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place, mat2 footprint,
                         float side, uint which)
{
    float ink = 0.0;
    for (int i = 0; i < 4; ++i)
    {
        vec2 corner = vec2(i & 1, i >> 1) * 0.5 - 0.25;
        float distance = osgLabels_nearestInk(text, cell, place + footprint * corner, which);
        ink += clamp(distance * 2.0 / side + 0.5, 0.0, 1.0);
    }
    return 0.25 * ink;
}

float osgLabels_evenInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place, mat2 footprint,
                        float side, uint which)
{
    float large = smoothstep(osgLabels_Large.x, osgLabels_Large.y, 1.0 / side);
    float ink = 0.0;
    if (large < 1.0)
    {
        vec2 along = osgLabels_doubled(osgLabels_doubled(footprint[0])) +
                     osgLabels_doubled(osgLabels_doubled(footprint[1]));
        float reach = 0.6 * (abs(footprint[0].x) + abs(footprint[1].x));
        osgLabels_Square square = osgLabels_squareOf(side, along, reach);
        ink = osgLabels_inkInSquare(text, cell, place, square, which);
    }
    if (large > 0.0)
        ink = mix(ink, osgLabels_largeInk(text, cell, place, footprint, side, which), large);
    return ink;
}

// A footprint longer than wide: slices across its long axis, each as a square about the middle of
// the slice, weighed by the slice's width.
float osgLabels_longInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place, vec2 a, vec2 b,
                        float area, uint which)
{
    float difference = 0.5 * (dot(vec2(a.x, b.x), vec2(a.x, b.x)) -
                              dot(vec2(a.y, b.y), vec2(a.y, b.y)));
    vec2 twice = vec2(difference, a.x * a.y + b.x * b.y); // double the axis's angle
    float axis = length(twice);
    float longest = sqrt(0.5 * (dot(a, a) + dot(b, b)) + axis);
    vec2 direction = twice.x > 0.0 ? vec2(axis + twice.x, twice.y)
                                   : vec2(abs(twice.y), (axis - twice.x) * (twice.y < 0.0 ? -1.0 : 1.0));
    direction = normalize(direction);
    float count = clamp(ceil(osgLabels_Slices * longest * longest / max(area, 1e-30)), 1.0,
                        osgLabels_MostSlices);
    float side = max(area / longest, osgLabels_Slices * longest / osgLabels_MostSlices);

    // The footprint's sides a and b, both turned to run along the axis, a the longer there.
    vec2 run = vec2(dot(a, direction), dot(b, direction));
    a *= run.x < 0.0 ? -1.0 : 1.0;
    b *= run.y < 0.0 ? -1.0 : 1.0;
    run = abs(run);
    if (run.x < run.y)
    {
        vec2 swap = a;
        a = b;
        b = swap;
        run = run.yx;
    }
    float large = step(osgLabels_Large.y, 1.0 / side);
    osgLabels_Square square = osgLabels_squareOf(side, osgLabels_doubled(twice),
                                                 0.75 * side);
    square.level = floor(square.level + 0.5);
    float ink = 0.0, weight = 0.0;
    for (float i = 0.5; i < count; i += 1.0)
    {
        float at = (i / count - 0.5) * (run.x + run.y);
        vec2 ends = run.y > 1e-6 * run.x
                        ? clamp((at + vec2(-0.5, 0.5) * run.x) / run.y, -0.5, 0.5)
                        : vec2(-0.5, 0.5);
        float t = 0.5 * (ends.x + ends.y);
        vec2 p = place + (at - t * run.y) / run.x * a + t * b;
        float width = ends.y - ends.x;
        osgLabels_moveTo(cell, text, p.x);
        float share = large > 0.0
                          ? clamp(osgLabels_nearestInk(text, cell, p, which) / side + 0.5, 0.0, 1.0)
                          : osgLabels_inkInSquare(text, cell, p, square, which);
        ink += width * share;
        weight += width;
    }
    return ink / weight;
}

float osgLabels_ink(osgLabels_Text text, vec2 place, mat2 footprint, uint which)
{
    vec2 a = footprint[0], b = footprint[1];
    float area = abs(a.x * b.y - a.y * b.x);
    float side = sqrt(area);
    float legible = clamp(2.0 / max(side * osgLabels_legible.x, 1e-30) - 1.0, 0.0, 1.0);
    float mean = osgLabels_letters.w * osgLabels_legible.y;
    if (legible <= 0.0)
        return mean;
    osgLabels_Cell cell = osgLabels_cellAt(text, place.x);
    float squares = dot(a, a) + dot(b, b);
    float ink = squares < 2.2 * area
                    ? osgLabels_evenInk(text, cell, place, footprint, side, which)
                    : osgLabels_longInk(text, cell, place, a, b, area, which);
    return mix(mean, ink, legible);
}

// Share of the pixel that ink covers, 0 to 1. place: em; footprint: em a pixel, by columns.
float osgLabels_coverage(osgLabels_Text text, vec2 place, mat2 footprint)
{
    return osgLabels_ink(text, place, footprint, 0u);
}

// Ink, and ink with its outline; both the same where no outline was asked for.
vec2 osgLabels_inkAndOutline(osgLabels_Text text, vec2 place, mat2 footprint)
{
    float ink = osgLabels_ink(text, place, footprint, 0u);
    return vec2(ink, osgLabels_letters.z > 1.0 ? osgLabels_ink(text, place, footprint, 1u) : ink);
}
