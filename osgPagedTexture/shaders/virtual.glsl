// Texels of virtual textures: pages of a physical texture, found through a table that has all
// levels of all textures. Texels of a level and pages count from the top left corner.

uniform usampler2D osgPagedTexture_table;
uniform sampler2D osgPagedTexture_pages;
// Of each unit's texture: width and height of level 0, payload and border of a page, in texels.
uniform vec4 osgPagedTexture_grids[4];
// Its row of the table, the finest level there, the last level, and how it is sampled: taps along
// the longer side of a pixel's footprint (bits 0 to 7), wrap modes of s and t (8, 10).
uniform ivec4 osgPagedTexture_rows[4];
// Slots in a row of the physical texture and its inverse, texels of a slot's side.
uniform vec3 osgPagedTexture_slots;
uniform int osgPagedTexture_timeRow; // Of the table: when the pages of slots came.
uniform int osgPagedTexture_show;    // What is shown instead of texels.
uniform vec2 osgPagedTexture_texel;  // Of the physical texture.
uniform vec2 osgPagedTexture_time; // Seconds, and how much of fading in is done in one; 0: all is.

struct osgPagedTexture_Grid
{
    int row;
    vec2 texels; // Of level 0.
    float payload;
    float border;
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
    vec4 sides = osgPagedTexture_grids[unit];
    ivec4 row = osgPagedTexture_rows[unit];
    return osgPagedTexture_Grid(row.x, sides.xy, sides.z, sides.w, row.y, row.z, row.w & 255,
                                ivec2((row.w >> 8) & 3, (row.w >> 10) & 3));
}

// 2^-level.
float osgPagedTexture_scale(int level)
{
    return intBitsToFloat((127 - level) << 23);
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

// As texels of level 0 from the top left corner. The last half texel shows what its beginning does,
// and its end would count as the next page.
vec2 osgPagedTexture_place(osgPagedTexture_Grid grid, vec2 coord)
{
    vec2 place = vec2(osgPagedTexture_wrap(grid.wrap.x, coord.x),
                      1.0 - osgPagedTexture_wrap(grid.wrap.y, coord.y));
    return min(place * grid.texels, grid.texels - 0.5);
}

vec2 osgPagedTexture_pageAt(osgPagedTexture_Grid grid, vec2 place, int level)
{
    return floor(place * (osgPagedTexture_scale(level) / grid.payload));
}

// Where the content of a page is: the level that is there in the upper 8 bits, its slot below.
uint osgPagedTexture_entry(osgPagedTexture_Grid grid, vec2 page, int level)
{
    uint origin = osgPagedTexture_word(4 + level - grid.finest, grid.row);
    return osgPagedTexture_word(int(origin & 0xffffu) + int(page.x),
                                int(origin >> 16) + int(page.y));
}

vec3 osgPagedTexture_levelColor(uint level)
{
    const vec3 colors[6] = vec3[](vec3(1.0), vec3(0.3, 1.0, 0.3), vec3(1.0, 1.0, 0.2),
                                  vec3(1.0, 0.6, 0.1), vec3(1.0, 0.25, 0.2), vec3(0.8, 0.3, 1.0));
    return colors[min(level, 5u)];
}

// `page` is of `level`, and its content that of the entry.
vec4 osgPagedTexture_fetch(osgPagedTexture_Grid grid, vec2 place, vec2 page, int level, uint entry)
{
    int there = int(entry >> 24);
    float slot = float(entry & 0xffffffu);
    // Not found anew from the place, which rounding may put beyond a border.
    vec2 shown = floor(page * osgPagedTexture_scale(there - level));
    vec2 inPage = place * osgPagedTexture_scale(there) - shown * grid.payload;
    // Half a texel inside of what the page has: beyond it lies another one's.
    vec2 texel = clamp(inPage, vec2(0.5 - grid.border), vec2(grid.payload + grid.border - 0.5));
    float slotRow = floor((slot + 0.5) * osgPagedTexture_slots.y);
    vec2 origin = vec2(slot - slotRow * osgPagedTexture_slots.x, slotRow) * osgPagedTexture_slots.z;
    vec4 color = textureLod(osgPagedTexture_pages,
                            (origin + texel + grid.border) * osgPagedTexture_texel, 0.0);
    if (osgPagedTexture_show == 0)
        return color;
    vec3 levelColor = osgPagedTexture_levelColor(uint(there));
    if (osgPagedTexture_show == 1)
        return vec4(color.rgb * levelColor, color.a);
    vec2 inside = min(inPage, grid.payload - inPage);
    return min(inside.x, inside.y) < 1.0 ? vec4(levelColor, color.a) : color;
}

// How much of the page in a slot has faded in.
float osgPagedTexture_faded(uint entry)
{
    if (osgPagedTexture_time.y <= 0.0)
        return 1.0;
    int slot = int(entry & 0xffffffu);
    int width = textureSize(osgPagedTexture_table, 0).x;
    uint since = osgPagedTexture_word(slot % width, osgPagedTexture_timeRow + slot / width);
    return clamp((osgPagedTexture_time.x - uintBitsToFloat(since)) * osgPagedTexture_time.y, 0.0,
                 1.0);
}

// Two levels, the finer one not finer than what is there. A page that has just come counts as
// something between its level and the next coarser one.
vec4 osgPagedTexture_mixed(osgPagedTexture_Grid grid, sampler2D own, vec2 coord, float lod)
{
    vec2 place = osgPagedTexture_place(grid, coord);
    float level = clamp(lod, float(grid.finest), float(grid.last));
    int finer = int(level);
    vec2 page = osgPagedTexture_pageAt(grid, place, finer);
    uint entry = osgPagedTexture_entry(grid, page, finer);
    if (entry >> 24 == osgPagedTexture_Empty)
        return textureLod(own, coord, 0.0);
    level = min(max(level, float(entry >> 24) + 1.0 - osgPagedTexture_faded(entry)),
                float(grid.last));
    if (int(level) > int(entry >> 24))
    {
        finer = int(level);
        page = osgPagedTexture_pageAt(grid, place, finer);
        entry = osgPagedTexture_entry(grid, page, finer);
    }
    vec4 color = osgPagedTexture_fetch(grid, place, page, finer, entry);
    float coarser = level - float(int(level));
    if (coarser <= 0.0)
        return color;
    int next = int(level) + 1;
    page = osgPagedTexture_pageAt(grid, place, next);
    entry = osgPagedTexture_entry(grid, page, next);
    return mix(color, osgPagedTexture_fetch(grid, place, page, next, entry), coarser);
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
