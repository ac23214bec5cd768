vec4 osgmr_sample(int unit, sampler2D own, vec2 coord)
{
    osgPagedTexture_Grid grid = osgPagedTexture_grid(unit);
    vec2 along;
    int taps;
    float lod;
    vec2 dx = dFdx(coord), dy = dFdy(coord);
    osgPagedTexture_footprint(grid, dx, dy, along, taps, lod);
    // What is coarser than a single page is the texture's own picture, which is that page.
    if (lod >= float(grid.last))
        return textureGrad(own, coord, dx, dy);
    if (taps == 1)
        return osgPagedTexture_mixed(grid, own, coord, lod);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < taps; ++i)
    {
        vec2 tap = coord + along * ((float(i) + 0.5) / float(taps) - 0.5);
        sum += osgPagedTexture_mixed(grid, own, tap, lod);
    }
    return sum / float(taps);
}
