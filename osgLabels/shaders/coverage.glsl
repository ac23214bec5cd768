// SPDX-License-Identifier: MIT
// How much of a pixel a label's ink covers. GlyphCoverage is its twin in C++; what the images hold
// is told in GlyphImages.h. Needs labelTable.glsl. One loop with two look-ups a turn, and no branch
// around it: software renderers run both sides of a branch. The loop tests at its end, since they
// run what follows a break once more with all pixels masked.
// OSGLABELS_PROPORTIONAL: each letter has its own advance. OSGLABELS_OUTLINE: with grown ink.
uniform sampler2DArray osgLabels_glyphs;
uniform vec4 osgLabels_levels[8];    // texels an em, offset in texels, margin in em; 7: distances
uniform vec4 osgLabels_quarters;     // of a distance image, in texels: their step, where they end
uniform vec2 osgLabels_layer;        // width of an image in texels, images a glyph
uniform vec3 osgLabels_letters;      // cell and overhang in em, mean ink of a cell
uniform vec2 osgLabels_legible;      // under x pixels an em ink fades, to y times its mean

const float osgLabels_Spread = 4.0 / 128.0; // em that 0 and 1 of a distance stand for
const float osgLabels_LargeFrom = 24.0; // pixels an em from where distances are used,
const float osgLabels_HugeFrom = 48.0;  // and from where one does for a pixel,
const float osgLabels_Nearing = 8.0;    // towards which four come together over so many pixels
const float osgLabels_MostLong = 12.0;  // how much longer than wide a footprint may be
const float osgLabels_MostTurns = 16.0; // of two look-ups

// Where a place lies among a text's letters; the index may be out of range.
struct osgLabels_Cell
{
    int index;
    float left; // em
    float width;
};

// Of the texture: a texel in coordinates, layers - 1, 1 / layers.
struct osgLabels_Size
{
    vec2 texel;
    int mask;
    float perLayer;
};

osgLabels_Size osgLabels_sizeOf()
{
    ivec3 size = textureSize(osgLabels_glyphs, 0);
    vec3 inverse = 1.0 / vec3(size);
    return osgLabels_Size(inverse.xy, size.z - 1, inverse.z);
}

// Layer, and column of images within the layers, whose number is a power of two.
vec2 osgLabels_layerOf(uint code, uint which, osgLabels_Size size)
{
    int image = int(code * uint(osgLabels_layer.y) + which);
    int layer = image & size.mask;
    return vec2(float(layer), float(image - layer) * size.perLayer);
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
    vec2 layer = osgLabels_layerOf(osgLabels_code(text, index), 0u, osgLabels_sizeOf());
    ivec3 texel = ivec3(layer.y * osgLabels_layer.x, 0.0, layer.x);
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
#ifdef OSGLABELS_SUMS
    if (text.length >= OSGLABELS_SUMS)
        return osgLabels_sumOf(text, (text.length + 15) >> 4);
#endif
    float width = 0.0;
    for (int i = 0; i < text.length; ++i)
        width += osgLabels_advanceAt(text, i);
    return width;
}

// A letter from which a place is near: with sums the first of those 16 among which it lies, else
// the text's begin.
osgLabels_Cell osgLabels_near(osgLabels_Text text, float x)
{
#ifdef OSGLABELS_SUMS
    if (text.length < OSGLABELS_SUMS)
        return osgLabels_Cell(-1, 0.0, 0.0);
    int low = 0, high = max(text.length - 1, 0) >> 4;
    while (low < high)
    {
        int middle = (low + high + 1) >> 1;
        bool isBehind = x >= osgLabels_sumOf(text, middle);
        low = isBehind ? middle : low;
        high = isBehind ? high : middle - 1;
    }
    return osgLabels_Cell(16 * low, osgLabels_sumOf(text, low),
                          osgLabels_advanceAt(text, 16 * low));
#else
    return osgLabels_Cell(-1, 0.0, 0.0);
#endif
}
#else
osgLabels_Cell osgLabels_near(osgLabels_Text text, float x)
{
    return osgLabels_Cell(-1, 0.0, 0.0);
}

osgLabels_Cell osgLabels_cellAt(osgLabels_Text text, osgLabels_Cell cell, float x)
{
    float index = floor(x * (1.0 / osgLabels_letters.x));
    return osgLabels_Cell(int(index), index * osgLabels_letters.x, osgLabels_letters.x);
}

osgLabels_Cell osgLabels_neighbour(osgLabels_Text text, osgLabels_Cell cell, int step)
{
    return osgLabels_Cell(cell.index + step, cell.left + float(step) * cell.width, cell.width);
}

float osgLabels_width(osgLabels_Text text) { return float(text.length) * osgLabels_letters.x; }
#endif

// How letters' images are read: all that is the same over a pixel.
struct osgLabels_Sampling
{
    osgLabels_Size size;
    bool isDistance; // else squares
    vec4 level;
    vec2 end;        // texels from where the next quarters are read; squares have none
    float finer;     // 1 / area of the finer squares
    float turn;      // of squares: 0 upright, 1 by 45 degrees
};

// For squares of about that area, so that what is read is mixed of the two nearest sizes.
osgLabels_Sampling osgLabels_samplingOf(float squared, float turn)
{
    osgLabels_Sampling sampling;
    sampling.size = osgLabels_sizeOf();
    sampling.isDistance = squared * osgLabels_LargeFrom * osgLabels_LargeFrom < 1.0;
    // By the exponent. A little finer: a finer image of the same squares is the sharper one.
    int level = clamp(124 - (floatBitsToInt(0.8 * squared) >> 23), 0, 6);
    sampling.level = osgLabels_levels[sampling.isDistance ? 7 : level];
    sampling.end = sampling.isDistance ? osgLabels_quarters.zw : vec2(1e9);
    sampling.finer = intBitsToFloat((level + 130) << 23);
    sampling.turn = sampling.isDistance ? 0.0 : turn;
    return sampling;
}

// A look-up: between the channels, factor and summand to a share of ink.
vec4 osgLabels_lookUp(osgLabels_Sampling sampling, float squared)
{
    float part = squared * sampling.finer;
    // Near 1 - log2(part): between two sizes, and a little beyond them.
    float mixing = clamp((2.0 - part) * (4.0 - part) * 0.33333333, -0.5, 1.5);
    float gain = osgLabels_Spread * inversesqrt(squared);
    return sampling.isDistance ? vec4(0.0, 0.0, 2.0 * gain, 0.5 - gain)
                               : vec4(sampling.turn, mixing, 1.0, 0.0);
}

// Share of a letter's ink about a place of the text.
float osgLabels_letterInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place,
                          osgLabels_Sampling sampling, vec4 lookUp, uint which)
{
    vec2 layer = osgLabels_layerOf(osgLabels_codeAt(text, cell.index), which, sampling.size);
    place.x -= cell.left;
    place = clamp(place, vec2(-sampling.level.w), vec2(cell.width, 1.0) + sampling.level.w);
    vec2 texel = place * sampling.level.x + sampling.level.yz;
    // The four channels of distances are the quarters of one image, which overlap by two texels.
    vec2 quarter = step(sampling.end, texel);
    texel -= quarter * osgLabels_quarters.xy;
    texel.x += layer.y * osgLabels_layer.x;
    vec4 read = textureLod(osgLabels_glyphs, vec3(texel * sampling.size.texel, layer.x), 0.0);
    vec2 mixing = lookUp.xy + quarter;
    vec2 pair = mix(read.xz, read.yw, mixing.x);
    float share = clamp(mix(pair.x, pair.y, mixing.y) * lookUp.z + lookUp.w, 0.0, 1.0);
    return cell.index >= 0 && cell.index < text.length ? share : 0.0;
}

// A footprint along its long axis. Across that it is of one height up to the shoulder, and falls to
// 0 at the end. Slices are cut from the middle to the end, and with each one that opposite to it:
// the nearer to the end, the shorter, since there they are lower too, by as much as lowers the error
// most: the fewer slices, the more.
struct osgLabels_Slicing
{
    vec2 a, b;      // sides, the one longer along the axis first,
    vec2 run;       // how long they are along it, and 1 / that
    vec2 inverse;
    float end, shoulder, height;
    float skew;     // 0: a rectangle, 1: a rhombus
    float bend;     // how much longer the slices in the middle are
};

osgLabels_Slicing osgLabels_slicingOf(vec2 a, vec2 b, vec2 twice, float axis, float area)
{
    vec2 direction = twice.x > 0.0 ? vec2(axis + twice.x, twice.y)
                                   : vec2(twice.y, axis - twice.x);
    direction *= inversesqrt(max(dot(direction, direction), 1e-36));
    vec2 run = vec2(dot(a, direction), dot(b, direction));
    a = run.x < 0.0 ? -a : a;
    b = run.y < 0.0 ? -b : b;
    run = abs(run);
    osgLabels_Slicing slicing;
    slicing.a = run.x < run.y ? b : a;
    slicing.b = run.x < run.y ? a : b;
    slicing.run = vec2(max(run.x, run.y), min(run.x, run.y));
    slicing.inverse = 1.0 / max(slicing.run, 1e-18);
    slicing.end = 0.5 * (slicing.run.x + slicing.run.y);
    slicing.shoulder = 0.5 * (slicing.run.x - slicing.run.y);
    slicing.height = area * slicing.inverse.x;
    slicing.skew = slicing.run.y * slicing.inverse.x;
    slicing.bend = 0.0;
    return slicing;
}

// The end of the slice that ends at a share of all; area and moment from the middle up to there.
vec3 osgLabels_upTo(osgLabels_Slicing slicing, float share)
{
    float rest = 1.0 - share;
    float end = slicing.end * share * (1.0 + slicing.bend * rest * rest);
    float over = max(end - slicing.shoulder, 0.0);
    float fallen = over * min(over * slicing.inverse.y, 1.0);
    return vec3(end, end - 0.5 * fallen,
                0.5 * end * end - fallen * (0.5 * slicing.shoulder + 0.33333333 * over));
}

// What stands for a slice: a square's place from the footprint's middle and its area.
vec3 osgLabels_squareOf(osgLabels_Slicing slicing, vec3 slice)
{
    float along = slice.z / slice.y;
    float t = 0.5 * clamp((along - slicing.shoulder) * slicing.inverse.y, 0.0, 1.0);
    float s = (along - t * slicing.run.y) * slicing.inverse.x;
    // As high as the slice; but where slices are longer than that, letters would show between.
    float side = max(slicing.height * (1.0 - 2.0 * t), 0.6 * slice.x);
    return vec3(s * slicing.a + t * slicing.b, side * side);
}

float osgLabels_ink(osgLabels_Text text, vec2 place, mat2 footprint, uint which)
{
    vec2 a = footprint[0], b = footprint[1];
    vec2 columns = a * a + b * b;
    float squares = columns.x + columns.y;
    float area = max(abs(a.x * b.y - a.y * b.x), 1e-30);

    // The long axis, as a vector of twice its angle. Slices from 1.65 times longer than wide on.
    vec2 twice = vec2(0.5 * (columns.x - columns.y), a.x * a.y + b.x * b.y);
    float axis = length(twice);
    bool isLong = squares > 2.26 * area;
    osgLabels_Slicing slicing = osgLabels_slicingOf(a, b, twice, axis, area);
    float ratio = min((0.5 * squares + axis) / area, osgLabels_MostLong);
    float slices = ratio + slicing.skew * (0.6 * ratio + 0.5);

    // Else quarters of large letters, and of pixels that are 1.15 times longer than wide.
    float pixels = inversesqrt(area); // an em
    float spread = squares > 2.02 * area ? 1.0
                   : pixels < osgLabels_LargeFrom
                       ? 0.0
                       : clamp((osgLabels_HugeFrom - pixels) / osgLabels_Nearing, 0.0, 1.0);
    float quartered = area * (1.0 - 0.75 * spread * spread); // what a look-up covers
    bool isPair = !isLong && spread == 0.0;

    float typical = isLong ? slicing.height * slicing.height * (1.0 - 0.4 * slicing.skew)
                           : quartered;
    vec2 doubled = isLong ? twice : vec2(a.x * a.x - a.y * a.y, 2.0 * a.x * a.y);
    float turn = doubled.y * doubled.y / max(dot(doubled, doubled), 1e-36);
    osgLabels_Sampling sampling = osgLabels_samplingOf(typical, turn);

    // Two look-ups a turn: of two slices or quarters, or of a letter and its nearer neighbour.
    float turns = isLong ? clamp(ceil(0.5 * slices - 0.2), 1.0, osgLabels_MostTurns)
                         : isPair ? 1.0 : 2.0;
    float perTurn = 1.0 / turns;
    slicing.bend = slicing.skew * (0.3 + 1.2 * perTurn);
    osgLabels_Cell cell = osgLabels_cellAt(text, osgLabels_near(text, place.x), place.x);
    osgLabels_Cell neighbour =
        osgLabels_neighbour(text, cell, place.x - cell.left < 0.5 * cell.width ? -1 : 1);
    float ink = 0.0, weight = 0.0, i = 0.0;
    vec3 before = vec3(0.0);
    do
    {
        vec2 off = spread * (0.25 * a + (i > 0.0 ? -0.25 : 0.25) * b);
        vec3 upTo = osgLabels_upTo(slicing, (i + 1.0) * perTurn);
        vec3 slice = upTo - before;
        vec3 square = isLong ? osgLabels_squareOf(slicing, slice) : vec3(off, quartered);
        float part = isLong ? slice.y : 1.0;
        before = upTo;
        vec4 lookUp = osgLabels_lookUp(sampling, square.z);
        vec2 at = place + square.xy, opposite = place - square.xy;
        cell = osgLabels_cellAt(text, cell, at.x);
        osgLabels_Cell other = osgLabels_cellAt(text, cell, opposite.x);
        if (isPair)
            other = neighbour;
        ink += part * (osgLabels_letterInk(text, cell, at, sampling, lookUp, which) +
                       osgLabels_letterInk(text, other, opposite, sampling, lookUp, which));
        weight += isPair ? part : 2.0 * part;
        i += 1.0;
    } while (i < turns);
    ink = clamp(ink / weight, 0.0, 1.0);
    float faint = area * osgLabels_legible.x * osgLabels_legible.x;
    float legible = clamp(2.0 * inversesqrt(max(faint, 1e-30)) - 1.0, 0.0, 1.0);
    float mean = osgLabels_letters.z * osgLabels_legible.y;
    return legible > 0.0 ? mix(mean, ink, legible) : mean; // also for footprints beyond numbers
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
