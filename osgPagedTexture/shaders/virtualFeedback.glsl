// Says which page a pixel needs: its texture's row, level, x and y, each as 16 bits.

uniform vec2 osgPagedTexture_sharper; // What derivatives are multiplied by; a number of the frame.

vec4 osgPagedTexture_need(int unit, vec2 coord)
{
    osgPagedTexture_Grid grid = osgPagedTexture_grid(unit);
    vec2 along;
    int taps;
    float lod;
    osgPagedTexture_footprint(grid, dFdx(coord) * osgPagedTexture_sharper.x,
                              dFdy(coord) * osgPagedTexture_sharper.x, along, taps, lod);
    // One of the taps, another one in each frame and pixel.
    float chance = fract(52.9829189 * fract(dot(gl_FragCoord.xy + 5.588238 *
                                                osgPagedTexture_sharper.y,
                                                vec2(0.06711056, 0.00583715))));
    if (taps > 1)
        coord += along * (chance - 0.5);
    int level = int(clamp(lod, 0.0, float(grid.last)));
    vec2 page = osgPagedTexture_pageAt(grid, osgPagedTexture_place(grid, coord), level);
    return vec4(grid.row + 1, level, page) / 65535.0;
}

vec4 osgmr_sample(int unit, sampler2D own, vec2 coord)
{
    return texture(own, coord);
}
