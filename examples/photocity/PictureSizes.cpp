// SPDX-License-Identifier: MIT
#include "PictureSizes.h"

#include "../city/CityRandom.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr int LeastSide = 512, MostSide = 8192;

/// Shares of sides of 512, 1024, 2048, 4096; the rest has 8192.
constexpr double Shares[] = {0.22, 0.36, 0.30, 0.10};

CityRandom randomOf(const Picture& picture)
{
    return CityRandom(picture.seed ^ 0x51ed270bu);
}

int powerOfTwo(double side, double dither)
{
    return std::clamp(1 << int(std::floor(std::log2(side) + dither)), LeastSide, MostSide);
}

/// Odd, or even where that is allowed.
int anySide(double side, bool even)
{
    const int rounded = std::clamp(int(std::lround(side)), LeastSide + 1, MostSide - 1);
    return even ? rounded : rounded | 1;
}

} // namespace

double naturalPixels(const Picture& picture)
{
    CityRandom random = randomOf(picture);
    double share = random(0, 1);
    double side = LeastSide;
    for (const double own : Shares)
    {
        if (share < own)
            break;
        share -= own;
        side *= 2.0;
    }
    return side * side;
}

void setSize(Picture& picture, double pixels, bool exact)
{
    CityRandom random = randomOf(picture);
    random(0, 1); // naturalPixels()' own
    const bool powers = random(0, 1) < 0.6 && !exact;
    const double dither = random(0, 1),
                 shape = std::clamp(picture.height / picture.width, 0.5, 2.0);
    if (!picture.isJpeg())
    {
        picture.columns = 512 << (picture.seed >> 4 & 1);
        picture.rows = picture.use == PictureUse::Fence ? picture.columns / 2 : picture.columns;
        return;
    }
    const double columns = std::sqrt(pixels / shape);
    if (powers)
    {
        picture.columns = powerOfTwo(columns, dither);
        picture.rows = powerOfTwo(columns * shape, dither);
        return;
    }
    picture.columns = anySide(columns, false);
    picture.rows = anySide(columns * shape, dither > 0.7);
}
