// SPDX-License-Identifier: MIT
// What the pixels of a store must be, computed the plain way: the whole atlas in memory, each level
// in floating point from the one before, each tile cut out of it.
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/Pixels.h>
#include <osgPagedTexture/TileStore.h>

#include <array>
#include <vector>

namespace osgPagedTexture
{

/// A picture of 1, 3 or 4 channels whose light (or code values) is not rounded; top row first.
struct LightPicture
{
    int width = 0;
    int height = 0;
    int channels = 0;
    bool linearLight = true;
    std::vector<double> values; ///< Colours times alpha, 0..1; alpha.

    double* at(int x, int y) { return &values[(std::size_t(y) * width + x) * channels]; }
    const double* at(int x, int y) const
    {
        return &values[(std::size_t(y) * width + x) * channels];
    }
    /// A pixel as code values that are not rounded.
    std::array<double, 4> code(int x, int y) const;
};

/// Level 0: photographs (as Pixels, the bottom row first) at their places with their padding.
LightPicture paintReference(const AtlasLayout& layout, const std::vector<Pixels>& photos,
                            int channels, const TileColor& background, bool linearLight = true);

/// One level further; the last row or column of an odd number counts twice.
LightPicture halveReference(const LightPicture& fine);

/// The largest difference of a tile's pixels and the reference's, in code values; what lies
/// beyond the picture repeats its edge. 256 where the sizes differ.
double differenceOf(const Pixels& tile, const PixelRect& area, const LightPicture& level);

/// A level of a store as a picture whose rows go from the top, each tile without its border. Where
/// there is nothing stands the background.
LightPicture readLevel(const TileReader& reader, int level, int channels,
                       const TileColor& background, bool linearLight = true);

} // namespace osgPagedTexture
