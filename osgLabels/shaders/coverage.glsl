// SPDX-License-Identifier: MIT
// How much of a pixel a label's ink covers. GlyphCoverage is its twin in C++; what the images hold
// is told in GlyphImages.h. Needs labelTable.glsl. One loop with two look-ups a turn, and no branch
// around it: software renderers run both sides of a branch, and a loop's turn costs them much.
// OSGLABELS_PROPORTIONAL: each letter has its own advance. OSGLABELS_OUTLINE: with grown ink.
uniform sampler2DArray osgLabels_glyphs;
uniform vec4 osgLabels_levels[8];    // texels an em, offset in texels, margin in em; 7: distances
uniform vec4 osgLabels_quarters;     // of a distance image, in texels: their step, where they end
uniform vec2 osgLabels_layer;        // width of an image in texels, images a glyph
uniform vec3 osgLabels_letters;      // cell and overhang in em, mean ink of a cell
uniform vec2 osgLabels_legible;      // under x pixels an em ink fades, to y times its mean

const float osgLabels_Spread = 4.0 / 128.0; // em that 0 and 1 of a distance stand for
const float osgLabels_LargeFrom = 20.0;     // pixels an em from where distances are used,
const float osgLabels_HugeFrom = 44.0;      // and from where one does for a pixel
const float osgLabels_Slices = 2.5;         // of a square's side, along a long footprint
const float osgLabels_MostSlices = 32.0;

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
    float width = 0.0;
    for (int i = 0; i < text.length; ++i)
        width += osgLabels_advanceAt(text, i);
    return width;
}
#else
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

// How a letter's image is read: all that is the same over a pixel.
struct osgLabels_Sampling
{
    vec4 level;
    vec4 mixing;     // of the channels
    float distances; // 1 where the image is of distances, 0 where of squares
    vec2 gain;       // factor and summand from what was read to a share of ink
    osgLabels_Size size;
};

// Share of a letter's ink about a place of the text.
float osgLabels_letterInk(osgLabels_Text text, osgLabels_Cell cell, vec2 place,
                          osgLabels_Sampling sampling, uint which)
{
    vec2 layer = osgLabels_layerOf(osgLabels_codeAt(text, cell.index), which, sampling.size);
    place.x -= cell.left;
    place = clamp(place, vec2(-sampling.level.w), vec2(cell.width, 1.0) + sampling.level.w);
    vec2 texel = place * sampling.level.x + sampling.level.yz;
    // The four channels of distances are the quarters of one image, which overlap by two texels.
    vec2 quarter = step(osgLabels_quarters.zw, texel) * sampling.distances;
    vec2 other = vec2(sampling.distances) - quarter;
    vec4 mixing = sampling.mixing + vec4(other.x, quarter.x, other.x, quarter.x) *
                                        vec4(other.y, other.y, quarter.y, quarter.y);
    texel -= quarter * osgLabels_quarters.xy;
    texel.x += layer.y * osgLabels_layer.x;
    vec4 read = textureLod(osgLabels_glyphs, vec3(texel * sampling.size.texel, layer.x), 0.0);
    float share = clamp(dot(read, mixing) * sampling.gain.x + sampling.gain.y, 0.0, 1.0);
    return cell.index >= 0 && cell.index < text.length ? share : 0.0;
}

float osgLabels_ink(osgLabels_Text text, vec2 place, mat2 footprint, uint which)
{
    vec2 a = footprint[0], b = footprint[1];
    vec2 columns = a * a + b * b;
    float squares = columns.x + columns.y;
    float area = max(abs(a.x * b.y - a.y * b.x), 1e-30);

    // The long axis, as a vector of twice its angle, and how much longer it is.
    vec2 twice = vec2(0.5 * (columns.x - columns.y), a.x * a.y + b.x * b.y);
    float axis = length(twice);
    float longest = 0.5 * squares + axis; // squared
    bool isLong = squares > 2.2 * area;
    float ratio = isLong ? longest / area : 1.0;

    // A look-up is of a square: of the pixel's area, or as wide as a long pixel is narrow.
    const float least = osgLabels_Slices / osgLabels_MostSlices;
    float squared = max(area / ratio, isLong ? longest * least * least : 0.0);
    float pixels = inversesqrt(squared); // an em
    bool isDistance = pixels > osgLabels_LargeFrom;
    bool isQuartered = isDistance && !isLong && pixels < osgLabels_HugeFrom;
    float count = isLong ? min(ceil(osgLabels_Slices * ratio), osgLabels_MostSlices)
                         : isQuartered ? 4.0 : 2.0;

    float level = clamp(-log2(squared) - 2.0, 0.0, 6.999);
    float finer = fract(level);
    vec2 doubled = isLong ? twice : vec2(a.x * a.x - a.y * a.y, 2.0 * a.x * a.y);
    float turn = doubled.y * doubled.y / max(dot(doubled, doubled), 1e-36);
    osgLabels_Sampling sampling;
    sampling.size = osgLabels_sizeOf();
    sampling.level = osgLabels_levels[isDistance ? 7 : int(level)];
    sampling.distances = isDistance ? 1.0 : 0.0;
    sampling.mixing = vec4(1.0 - turn, turn, 1.0 - turn, turn) *
                      vec4(vec2(1.0 - finer), vec2(finer)) * (1.0 - sampling.distances);
    float gain = (isQuartered ? 2.0 : 1.0) * osgLabels_Spread * pixels;
    sampling.gain = isDistance ? vec2(2.0 * gain, 0.5 - gain) : vec2(1.0, 0.0);

    // Slices lie across the axis, each a square in the middle of what it cuts of the footprint.
    // Sides are turned to run along the axis, the longer there first.
    vec2 direction = twice.x > 0.0 ? vec2(axis + twice.x, twice.y)
                                   : vec2(twice.y, axis - twice.x);
    vec2 run = vec2(dot(a, direction), dot(b, direction));
    a = run.x < 0.0 ? -a : a;
    b = run.y < 0.0 ? -b : b;
    run = abs(run);
    vec2 first = run.x < run.y ? b : a;
    b = run.x < run.y ? a : b;
    a = first;
    run = vec2(max(run.x, run.y), min(run.x, run.y));
    vec2 inverse = 1.0 / max(run, 1e-25);

    // Two look-ups a turn: of two slices or quarters, or of a letter and its nearer neighbour.
    bool isPair = count == 2.0 && !isLong;
    vec2 toAlong = vec2(1.0, 0.5 - 0.5 * count) * (run.x + run.y) / count;
    float ink = 0.0, weight = isPair ? 1.0 : 0.0;
    osgLabels_Cell cell = osgLabels_cellAt(text, osgLabels_Cell(-1, 0.0, 0.0), place.x);
    for (float i = 0.0; i < count; i += 2.0)
    {
        vec2 along = vec2(i, i + 1.0) * toAlong.x + toAlong.y;
        vec2 low = clamp((along - 0.5 * run.x) * inverse.y, -0.5, 0.5);
        vec2 high = clamp((along + 0.5 * run.x) * inverse.y, -0.5, 0.5);
        vec2 t = 0.5 * (low + high), s = (along - t * run.y) * inverse.x, width = high - low;
        t = isLong ? t : isQuartered ? vec2(0.25 * i - 0.25) : vec2(0.0);
        s = isLong ? s : isQuartered ? vec2(-0.25, 0.25) : vec2(0.0);
        width = isLong ? vec2(width.x, i + 1.0 < count ? width.y : 0.0) : vec2(1.0);
        vec2 at = place + s.x * a + t.x * b, next = place + s.y * a + t.y * b;
        cell = osgLabels_cellAt(text, cell, at.x);
        osgLabels_Cell other = osgLabels_cellAt(text, cell, next.x);
        if (isPair)
            other = osgLabels_neighbour(text, cell, at.x - cell.left < 0.5 * cell.width ? -1 : 1);
        ink += width.x * osgLabels_letterInk(text, cell, at, sampling, which) +
               width.y * osgLabels_letterInk(text, other, next, sampling, which);
        weight += isPair ? 0.0 : width.x + width.y;
    }
    ink = min(ink / weight, 1.0);
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
