// Texels of virtual textures: pages of a physical texture, found through a table that has all
// levels of all textures. Texels of a level and pages count from the top left corner.

uniform usampler2D osgPagedTexture_table;
uniform sampler2D osgPagedTexture_pages;
// Of each unit: the row of the table that describes its texture (bits 0 to 15), taps along the
// longer side of a pixel's footprint (16 to 23), wrap modes of s and t (24, 26).
uniform ivec4 osgPagedTexture_textures;
// Slots in a row of the physical texture, texels of a slot's side, the table's row with the times
// of slots, what is shown instead of texels.
uniform ivec4 osgPagedTexture_slots;
uniform vec2 osgPagedTexture_texel; // Of the physical texture.
uniform vec2 osgPagedTexture_time;  // Seconds, and how much of fading in is done in one.

struct osgPagedTexture_Grid
{
    int row;
    ivec2 size; // Texels of level 0.
    vec2 texels;
    int payload;
    int border;
    int finest; // Of the table: what is finer is not there.
    int last;   // A single page.
    int taps;
    ivec2 wrap;
};

const uint osgPagedTexture_Empty = 255u; // As level: nothing is there.

uint osgPagedTexture_word(int x, int y)
{
    return texelFetch(osgPagedTexture_table, ivec2(x, y), 0).r;
}

osgPagedTexture_Grid osgPagedTexture_grid(int unit)
{
    int code = osgPagedTexture_textures[unit];
    osgPagedTexture_Grid grid;
    grid.row = code & 65535;
    grid.taps = (code >> 16) & 255;
    grid.wrap = ivec2((code >> 24) & 3, (code >> 26) & 3);
    grid.size = ivec2(osgPagedTexture_word(0, grid.row), osgPagedTexture_word(1, grid.row));
    grid.texels = vec2(grid.size);
    uint sides = osgPagedTexture_word(2, grid.row);
    uint levels = osgPagedTexture_word(3, grid.row);
    grid.payload = int(sides & 0xffffffu);
    grid.border = int(sides >> 24);
    grid.finest = int(levels & 255u);
    grid.last = int(levels >> 8);
    return grid;
}

// 0 clamps to the edge, 1 repeats, 2 mirrors.
float osgPagedTexture_wrap(int mode, float x)
{
    if (mode == 1)
        return fract(x);
    if (mode == 2)
        return 1.0 - abs(1.0 - 2.0 * fract(0.5 * x));
    return clamp(x, 0.0, 1.0);
}

// From the top left corner, in 0 to 1.
vec2 osgPagedTexture_place(osgPagedTexture_Grid grid, vec2 coord)
{
    return vec2(osgPagedTexture_wrap(grid.wrap.x, coord.x),
                1.0 - osgPagedTexture_wrap(grid.wrap.y, coord.y));
}

ivec2 osgPagedTexture_pageAt(osgPagedTexture_Grid grid, vec2 place, int level)
{
    ivec2 pages = (((grid.size - 1) >> level) + grid.payload) / grid.payload;
    vec2 texel = place * grid.texels * exp2(-float(level));
    return clamp(ivec2(texel / float(grid.payload)), ivec2(0), pages - 1);
}

// Where the content of a place is on a level: the level that is there in the upper 8 bits, its slot
// below.
uint osgPagedTexture_entry(osgPagedTexture_Grid grid, vec2 place, int level)
{
    level = max(level, grid.finest);
    uint origin = osgPagedTexture_word(4 + level - grid.finest, grid.row);
    ivec2 page = osgPagedTexture_pageAt(grid, place, level);
    return osgPagedTexture_word(int(origin & 0xffffu) + page.x, int(origin >> 16) + page.y);
}

vec3 osgPagedTexture_levelColor(uint level)
{
    const vec3 colors[6] = vec3[](vec3(1.0), vec3(0.3, 1.0, 0.3), vec3(1.0, 1.0, 0.2),
                                  vec3(1.0, 0.6, 0.1), vec3(1.0, 0.25, 0.2), vec3(0.8, 0.3, 1.0));
    return colors[min(level, 5u)];
}

vec4 osgPagedTexture_fetch(osgPagedTexture_Grid grid, vec2 place, uint entry)
{
    int level = int(entry >> 24);
    int slot = int(entry & 0xffffffu);
    vec2 page = vec2(osgPagedTexture_pageAt(grid, place, level));
    vec2 inPage = place * grid.texels * exp2(-float(level)) - page * float(grid.payload);
    // Half a texel inside of what the page has: beyond it lies another one's.
    vec2 most = vec2(float(grid.payload + grid.border) - 0.5);
    vec2 texel = clamp(inPage, vec2(0.5 - float(grid.border)), most) + float(grid.border);
    vec2 origin = vec2(slot % osgPagedTexture_slots.x, slot / osgPagedTexture_slots.x);
    vec4 color = textureLod(osgPagedTexture_pages,
                            (origin * float(osgPagedTexture_slots.y) + texel) *
                                osgPagedTexture_texel, 0.0);
    if (osgPagedTexture_slots.w == 0)
        return color;
    if (osgPagedTexture_slots.w == 1)
        return vec4(color.rgb * osgPagedTexture_levelColor(uint(level)), color.a);
    vec2 inside = min(inPage, float(grid.payload) - inPage);
    return min(inside.x, inside.y) < 1.0 ? vec4(osgPagedTexture_levelColor(uint(level)), color.a)
                                         : color;
}

// One level, of what is there.
vec4 osgPagedTexture_tap(osgPagedTexture_Grid grid, sampler2D own, vec2 coord, vec2 place, int level)
{
    uint entry = osgPagedTexture_entry(grid, place, level);
    return entry >> 24 == osgPagedTexture_Empty ? textureLod(own, coord, 0.0)
                                                : osgPagedTexture_fetch(grid, place, entry);
}

// Two levels, the finer one not finer than what is there. A page that has just come counts as
// something between its level and the next coarser one.
vec4 osgPagedTexture_mixed(osgPagedTexture_Grid grid, sampler2D own, vec2 coord, float lod)
{
    vec2 place = osgPagedTexture_place(grid, coord);
    float level = clamp(lod, 0.0, float(grid.last));
    uint entry = osgPagedTexture_entry(grid, place, int(level));
    if (entry >> 24 == osgPagedTexture_Empty)
        return textureLod(own, coord, 0.0);
    int slot = int(entry & 0xffffffu);
    int width = textureSize(osgPagedTexture_table, 0).x;
    float since = uintBitsToFloat(
        osgPagedTexture_word(slot % width, osgPagedTexture_slots.z + slot / width));
    float faded = clamp((osgPagedTexture_time.x - since) * osgPagedTexture_time.y, 0.0, 1.0);
    level = min(max(level, float(entry >> 24) + 1.0 - faded), float(grid.last));
    int finer = int(level);
    if (finer != int(entry >> 24))
        entry = osgPagedTexture_entry(grid, place, finer);
    vec4 color = osgPagedTexture_fetch(grid, place, entry);
    float coarser = level - float(finer);
    return coarser > 0.0
               ? mix(color, osgPagedTexture_tap(grid, own, coord, place, finer + 1), coarser)
               : color;
}

// Footprint of a pixel: the longer side as texture coordinates, the taps along it, and the level
// of each, as in EXT_texture_filter_anisotropic.
void osgPagedTexture_footprint(osgPagedTexture_Grid grid, vec2 dx, vec2 dy, out vec2 along,
                               out int taps, out float lod)
{
    float a = length(dx * grid.texels), b = length(dy * grid.texels);
    float longer = max(a, b), shorter = min(a, b);
    along = a > b ? dx : dy;
    taps = 1;
    if (grid.taps > 1 && longer > 1.0)
        taps = int(clamp(ceil(longer / max(shorter, 1e-6)), 1.0, float(grid.taps)));
    lod = log2(max(longer, 1e-20) / float(taps));
}
