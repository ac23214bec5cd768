// Where the texels of a place are: the level that is there with its page, the one next to it, and
// how far in between the place is filtered.
struct osgPagedTexture_Found
{
    vec2 page, nextPage; // Of the levels that are there.
    ivec2 level;         // Those.
    vec2 slot, nextSlot; // Where the payload of the pages begins, in texels.
    float next;          // Share of the coarser one.
};

// Where what an entry names begins in the physical texture.
vec2 osgPagedTexture_origin(osgPagedTexture_Grid grid, uint entry)
{
    float slot = float(entry & 0xffffffu);
    float row = floor((slot + 0.5) * osgPagedTexture_slots.y);
    return vec2(slot - row * osgPagedTexture_slots.x, row) * osgPagedTexture_slots.z + grid.border;
}

// How much of the page in a slot has faded in.
float osgPagedTexture_faded(uint entry)
{
#ifdef osgPagedTexture_Fades
    if (osgPagedTexture_time.y <= 0.0)
        return 1.0;
    int slot = int(entry & 0xffffffu);
    int width = textureSize(osgPagedTexture_table, 0).x;
    uint since = osgPagedTexture_word(slot % width, osgPagedTexture_timeRow + slot / width);
    return clamp((osgPagedTexture_time.x - uintBitsToFloat(since)) * osgPagedTexture_time.y, 0.0,
                 1.0);
#else
    return 1.0;
#endif
}

// The page of an entry that was found for `page` of `level`. Not found anew from the place, which
// rounding may put beyond a border.
vec2 osgPagedTexture_thereOf(vec2 page, int level, uint entry)
{
    return floor(page * osgPagedTexture_scale(int(entry >> 24) - level));
}

// False where nothing is there. A page that has just come counts as something between its level
// and the next coarser one.
bool osgPagedTexture_find(osgPagedTexture_Grid grid, vec2 place, float lod,
                          out osgPagedTexture_Found found)
{
    float level = clamp(lod, float(grid.finest), float(grid.last));
    int asked = int(level);
    vec2 page = osgPagedTexture_pageAt(grid, place, asked);
    uint entry = osgPagedTexture_entry(grid, page, asked);
    found.level.x = int(entry >> 24);
    found.page = osgPagedTexture_thereOf(page, asked, entry);
    found.slot = osgPagedTexture_origin(grid, entry);
    float finest = float(found.level.x);
    found.next = clamp(max(level - finest, 1.0 - osgPagedTexture_faded(entry)), 0.0, 1.0);
    int coarser = min(found.level.x + 1, grid.last);
    page = osgPagedTexture_pageAt(grid, place, coarser);
    uint next = osgPagedTexture_entry(grid, page, coarser);
    found.level.y = int(next >> 24);
    found.nextPage = osgPagedTexture_thereOf(page, coarser, next);
    found.nextSlot = osgPagedTexture_origin(grid, next);
    return found.level.x != osgPagedTexture_Empty && found.level.y != osgPagedTexture_Empty;
}

vec4 osgPagedTexture_texel(osgPagedTexture_Grid grid, vec2 inPage, vec2 slot, int level)
{
    // Half a texel inside of what the page has: beyond it lies another one's.
    vec2 texel = clamp(inPage, vec2(0.5 - grid.border), vec2(grid.payload + grid.border - 0.5));
    vec4 color = textureLod(osgPagedTexture_pages, (slot + texel) * osgPagedTexture_pixel, 0.0);
#ifdef osgPagedTexture_Shows
    const vec3 colors[6] = vec3[](vec3(1.0), vec3(0.3, 1.0, 0.3), vec3(1.0, 1.0, 0.2),
                                  vec3(1.0, 0.6, 0.1), vec3(1.0, 0.25, 0.2), vec3(0.8, 0.3, 1.0));
    vec3 levelColor = colors[min(level, 5)];
    if (osgPagedTexture_show == 1)
        return vec4(color.rgb * levelColor, color.a);
    vec2 inside = min(inPage, grid.payload - inPage);
    if (min(inside.x, inside.y) < 1.0)
        return vec4(levelColor, color.a);
#endif
    return color;
}

// Two levels, the finer one not finer than what is there.
vec4 osgPagedTexture_mixed(osgPagedTexture_Grid grid, osgPagedTexture_Found found, vec2 place)
{
    vec2 inPage = place * osgPagedTexture_scale(found.level.x) - found.page * grid.payload;
    vec2 inNext = place * osgPagedTexture_scale(found.level.y) - found.nextPage * grid.payload;
    return mix(osgPagedTexture_texel(grid, inPage, found.slot, found.level.x),
               osgPagedTexture_texel(grid, inNext, found.nextSlot, found.level.y), found.next);
}

vec4 osgmr_sample(int unit, sampler2D own, vec2 coord)
{
    osgPagedTexture_Grid grid = osgPagedTexture_grid(unit);
    vec2 along;
    int taps;
    float lod;
    vec2 dx = dFdx(coord), dy = dFdy(coord);
    osgPagedTexture_footprint(grid, dx, dy, along, taps, lod);
    vec2 first = coord - along * (0.5 - 0.5 / float(taps));
    vec2 place = osgPagedTexture_place(grid, first);
    osgPagedTexture_Found found;
    bool isThere = osgPagedTexture_find(grid, place, lod, found);
    // What is coarser than a single page is the texture's own picture, which is that page.
    if (lod >= float(grid.last) || !isThere)
        return textureGrad(own, coord, dx, dy);
#ifndef osgPagedTexture_Taps
    return osgPagedTexture_mixed(grid, found, place);
#else
    // Most footprints lie in one page, which is found once.
    vec2 stride = along * vec2(1.0, -1.0) * grid.texels / float(taps);
    vec2 end = osgPagedTexture_place(grid, first + along * (float(taps - 1) / float(taps)));
    int level = int(clamp(lod, float(grid.finest), float(grid.last)));
    // Far from where it would be is what has been wrapped or clamped; a quarter of a texel is more
    // than rounding makes of it.
    vec2 moved = abs(place + stride * float(taps - 1) - end);
    bool isOne = osgPagedTexture_pageAt(grid, place, level) ==
                     osgPagedTexture_pageAt(grid, end, level) &&
                 max(moved.x, moved.y) < 0.25;
    int together = isOne ? taps : 0;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < together; ++i)
        sum += osgPagedTexture_mixed(grid, found, place + stride * float(i));
    for (int i = together; i < taps; ++i)
    {
        place = osgPagedTexture_place(grid, first + along * (float(i) / float(taps)));
        osgPagedTexture_find(grid, place, lod, found);
        sum += osgPagedTexture_mixed(grid, found, place);
    }
    return sum / float(taps);
#endif
}
