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
uniform vec2 osgPagedTexture_pixel;  // Of the physical texture.
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

const int osgPagedTexture_Empty = 255; // As level: nothing is there.

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
#ifdef osgPagedTexture_Wraps
    if (mode == 1)
        return fract(x);
    if (mode == 2)
        return 1.0 - abs(1.0 - 2.0 * fract(0.5 * x));
#endif
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
