// SPDX-License-Identifier: MIT
// How much of a pixel a label's ink covers. GlyphCoverage is its twin in C++; what the images hold
// is told in GlyphImages.h. Needs labelTable.glsl. One loop with one look-up a turn, and no branch
// around it: software renderers run both sides of a branch.
// OSGLABELS_PROPORTIONAL: each letter has its own advance. OSGLABELS_OUTLINE: with grown ink.
uniform sampler2DArray osgLabels_glyphs;
uniform vec4 osgLabels_levels[8];    // texels an em, offset in texels, margin in em; 7: distances
uniform vec4 osgLabels_quarters;     // of a distance image, in texels: their step, where they end
uniform vec2 osgLabels_layer;        // width of an image in texels, images a glyph
uniform vec3 osgLabels_letters;      // cell and overhang in em, mean ink of a cell
uniform vec2 osgLabels_legible;      // under x pixels an em ink fades, to y times its mean

const float osgLabels_Spread = 4.0 / 128.0; // em that 0 and 1 of a distance stand for
const float osgLabels_LargeFrom = 20.0;     // pixels an em from where distances are used,
const float osgLabels_HugeFrom = 56.0;      // and from where one does for a pixel
const float osgLabels_Slices = 2.5;         // of a square's side, along a long footprint
const float osgLabels_MostSlices = 32.0;

// Where a place lies among a text's letters; the index may be out of range.
struct osgLabels_Cell
{
    int index;
    float left; // em
    float width;
};

// Layer, and column of images within the layers, whose number is a power of two.
ivec2 osgLabels_layerOf(uint code, uint which, int layers)
{
    uint image = code * uint(osgLabels_layer.y) + which;
    return ivec2(image & uint(layers - 1), image / uint(layers));
}

uint osgLabels_codeAt(osgLabels_Text text, int index)
{
    return osgLabels_code(text, clamp(index, 0, max(text.length - 1, 0)));
}

#ifdef OSGLABELS_PROPORTIONAL
float osgLabels_advanceAt(osgLabels_Text text, int index)
{
    if (index < 0 || index >= text.length)
        return 0.0;
    ivec2 layer = osgLabels_layerOf(osgLabels_code(text, index), 0u,
                                    textureSize(osgLabels_glyphs, 0).z);
    ivec3 texel = ivec3(layer.y * int(osgLabels_layer.x), 0, layer.x);
    return dot(texelFetch(osgLabels_glyphs, texel, 0), 255.0 * exp2(-vec4(0.0, 8.0, 16.0, 24.0)));
}

osgLabels_Cell osgLabels_cellAt(osgLabels_Text text, osgLabels_Cell cell, float x)
{
    while (x < cell.left && cell.index >= 0)
    {
        cell.width = osgLabels_advanceAt(text, --cell.index);
        cell.left -= cell.width;
    }
    while (x >= cell.left + cell.width && cell.index < text.length)
    {
        cell.left += cell.width;
        cell.width = osgLabels_advanceAt(text, ++cell.index);
    }
    return cell;
}

osgLabels_Cell osgLabels_neighbour(osgLabels_Text text, osgLabels_Cell cell, int step)
{
    float width = osgLabels_advanceAt(text, cell.index + step);
    return osgLabels_Cell(cell.index + step, step > 0 ? cell.left + cell.width : cell.left - width,
                          width);
}

float osgLabels_width(osgLabels_Text text)
{
    float width = 0.0;
    for (int i = 0; i < text.length; ++i)
        width += osgLabels_advanceAt(text, i);
    return width;
}
#else
osgLabels_Cell osgLabels_cellAt(osgLabels_Text text, osgLabels_Cell cell, float x)
{
    float index = floor(x / osgLabels_letters.x);
    return osgLabels_Cell(int(index), index * osgLabels_letters.x, osgLabels_letters.x);
}

osgLabels_Cell osgLabels_neighbour(osgLabels_Text text, osgLabels_Cell cell, int step)
{
    return osgLabels_Cell(cell.index + step, cell.left + float(step) * cell.width, cell.width);
}

float osgLabels_width(osgLabels_Text text) { return float(text.length) * osgLabels_letters.x; }
#endif

// How a letter's image is read: all that is the same over a pixel.
struct osgLabels_Sampling
{
    vec4 level;
    vec4 mixing;   // of the channels
    bool isDistance;
    float gain;    // from what was read to a share of ink
    float bias;
    float reach;   // from a cell's side, in em, where the neighbour's ink counts
};

// `side` of the square in em that a look-up stands for, `turned` the cosine of four times its
// angle.
osgLabels_Sampling osgLabels_samplingOf(float side, float turned, bool isDistance, float reach)
{
    float level = clamp(-2.0 * log2(side) - 2.0, 0.0, 6.999);
    float finer = fract(level);
    vec2 turn = vec2(0.5 + 0.5 * turned, 0.5 - 0.5 * turned);
    osgLabels_Sampling sampling;
    sampling.level = osgLabels_levels[isDistance ? 7 : int(level)];
    sampling.mixing = vec4(turn * (1.0 - finer), turn * finer);
    sampling.isDistance = isDistance;
    sampling.gain = isDistance ? 2.0 * osgLabels_Spread / side : 1.0;
    sampling.bias = isDistance ? 0.5 - osgLabels_Spread / side : 0.0;
    sampling.reach = (isDistance ? 0.0 : reach) + osgLabels_letters.y;
    return sampling;
}

// Share of a letter's ink about a place of the text.
float osgLabels_letterInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place,
                          osgLabels_Sampling sampling, uint which)
{
    ivec3 size = textureSize(osgLabels_glyphs, 0);
    ivec2 layer = osgLabels_layerOf(osgLabels_codeAt(text, cell.index), which, size.z);
    place.x -= cell.left;
    place = clamp(place, vec2(-sampling.level.w), vec2(cell.width, 1.0) + sampling.level.w);
    vec2 texel = place * sampling.level.x + sampling.level.yz;
    // The four channels of distances are the quarters of one image, which overlap by two texels.
    vec2 quarter = sampling.isDistance ? step(osgLabels_quarters.zw, texel) : vec2(0.0);
    vec2 other = 1.0 - quarter;
    vec4 channel = vec4(other.x, quarter.x, other.x, quarter.x) *
                   vec4(other.y, other.y, quarter.y, quarter.y);
    texel -= quarter * osgLabels_quarters.xy;
    texel.x += float(layer.y) * osgLabels_layer.x;
    vec4 read = textureLod(osgLabels_glyphs, vec3(texel / vec2(size.xy), float(layer.x)), 0.0);
    float value = dot(read, sampling.isDistance ? channel : sampling.mixing);
    float share = clamp(value * sampling.gain + sampling.bias, 0.0, 1.0);
    return cell.index >= 0 && cell.index < text.length ? share : 0.0;
}

// The real part of a vector's fourth power, as of a complex number.
float osgLabels_fourth(vec2 v)
{
    float real = v.x * v.x - v.y * v.y, imaginary = 2.0 * v.x * v.y;
    return real * real - imaginary * imaginary;
}

// A footprint as slices across its long axis. `a` and `b` are its sides, turned to run along the
// axis, by `run` em each, a the longer there.
struct osgLabels_Slicing
{
    vec2 a, b;
    vec2 run;
    float count;
    float side;   // of the square that stands for a slice, em
    float turned; // cosine of four times the axis's angle
};

osgLabels_Slicing osgLabels_slicingOf(vec2 a, vec2 b, float area)
{
    vec2 columns = a * a + b * b;
    vec2 twice = vec2(0.5 * (columns.x - columns.y), a.x * a.y + b.x * b.y);
    float axis = length(twice);
    float longest = sqrt(0.5 * (columns.x + columns.y) + axis);
    // Half of the angle, from the side where that does not cancel.
    vec2 direction = twice.x > 0.0 ? vec2(axis + twice.x, twice.y)
                                   : vec2(twice.y, axis - twice.x);
    direction /= max(length(direction), 1e-30);
    osgLabels_Slicing slicing;
    slicing.run = vec2(dot(a, direction), dot(b, direction));
    slicing.a = slicing.run.x < 0.0 ? -a : a;
    slicing.b = slicing.run.y < 0.0 ? -b : b;
    slicing.run = abs(slicing.run);
    bool isSwapped = slicing.run.x < slicing.run.y;
    vec4 sides = vec4(slicing.a, slicing.b);
    slicing.a = isSwapped ? sides.zw : sides.xy;
    slicing.b = isSwapped ? sides.xy : sides.zw;
    slicing.run = isSwapped ? slicing.run.yx : slicing.run;
    slicing.side = max(area / longest, longest * osgLabels_Slices / osgLabels_MostSlices);
    slicing.count = clamp(ceil(osgLabels_Slices * longest / slicing.side), 1.0,
                          osgLabels_MostSlices);
    slicing.turned = (twice.x * twice.x - twice.y * twice.y) / max(axis * axis, 1e-30);
    return slicing;
}

// The middle of a slice, from that of the footprint, and how wide the slice is there.
vec3 osgLabels_sliceAt(osgLabels_Slicing slicing, float i)
{
    float at = ((i + 0.5) / slicing.count - 0.5) * (slicing.run.x + slicing.run.y);
    vec2 ends = clamp((at + vec2(-0.5, 0.5) * slicing.run.x) / max(slicing.run.y, 1e-20), -0.5,
                      0.5);
    float t = 0.5 * (ends.x + ends.y);
    float s = (at - t * slicing.run.y) / slicing.run.x;
    return vec3(s * slicing.a + t * slicing.b, ends.y - ends.x);
}

float osgLabels_ink(osgLabels_Text text, vec2 place, mat2 footprint, uint which)
{
    vec2 a = footprint[0], b = footprint[1];
    float area = max(abs(a.x * b.y - a.y * b.x), 1e-30);
    float squares = dot(a, a) + dot(b, b);
    bool isLong = squares > 2.2 * area;
    osgLabels_Slicing slicing = osgLabels_slicingOf(a, b, area);
    float side = isLong ? slicing.side : sqrt(area);
    bool isDistance = side * osgLabels_LargeFrom < 1.0;
    bool isQuartered = isDistance && !isLong && side * osgLabels_HugeFrom > 1.0;
    slicing.count = isLong ? slicing.count : isQuartered ? 4.0 : 1.0;
    float squared = dot(a, a) * dot(a, a) + dot(b, b) * dot(b, b);
    float turned = isLong ? slicing.turned
                          : (osgLabels_fourth(a) + osgLabels_fourth(b)) / squared;
    osgLabels_Sampling sampling =
        osgLabels_samplingOf(isQuartered ? 0.5 * side : side, turned, isDistance,
                             isLong ? 0.75 * side : 0.6 * (abs(a.x) + abs(b.x)));

    osgLabels_Cell cell = osgLabels_cellAt(text, osgLabels_Cell(-1, 0.0, 0.0), place.x);
    float ink = 0.0, weight = 0.0;
    bool isSecond = false; // of the two letters that a place may see
    for (float i = 0.0; i < slicing.count;)
    {
        vec3 slice = osgLabels_sliceAt(slicing, i);
        vec3 quarter = vec3((mod(i, 2.0) - 0.5) * 0.5 * a + (floor(0.5 * i) - 0.5) * 0.5 * b, 1.0);
        slice = isLong ? slice : isQuartered ? quarter : vec3(0.0, 0.0, 1.0);
        vec2 at = place + slice.xy;
        cell = osgLabels_cellAt(text, cell, at.x);
        float fromLeft = at.x - cell.left, fromRight = cell.left + cell.width - at.x;
        osgLabels_Cell seen = cell;
        if (isSecond)
            seen = osgLabels_neighbour(text, cell, fromLeft < fromRight ? -1 : 1);
        ink += slice.z * osgLabels_letterInk(text, seen, at, sampling, which);
        isSecond = !isSecond && min(fromLeft, fromRight) < sampling.reach;
        weight += isSecond ? 0.0 : slice.z;
        i += isSecond ? 0.0 : 1.0;
    }
    ink = min(ink / weight, 1.0);
    float legible = clamp(2.0 / max(sqrt(area) * osgLabels_legible.x, 1e-30) - 1.0, 0.0, 1.0);
    return mix(osgLabels_letters.z * osgLabels_legible.y, ink, legible);
}

// Share of the pixel that ink covers, 0 to 1. place: em; footprint: em a pixel, by columns.
float osgLabels_coverage(osgLabels_Text text, vec2 place, mat2 footprint)
{
    return osgLabels_ink(text, place, footprint, 0u);
}

// Ink, and ink with its outline.
vec2 osgLabels_inkAndOutline(osgLabels_Text text, vec2 place, mat2 footprint)
{
    float ink = osgLabels_ink(text, place, footprint, 0u);
#ifdef OSGLABELS_OUTLINE
    return vec2(ink, osgLabels_ink(text, place, footprint, 1u));
#else
    return vec2(ink);
#endif
}
