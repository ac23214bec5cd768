// SPDX-License-Identifier: MIT
#include "AtlasReference.h"

#include <osgPagedTexture/TileExtract.h>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

double toLight(double code, bool linearLight)
{
    const double v = code / 255.0;
    if (!linearLight)
    {
        return v;
    }
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double toCode(double light, bool linearLight)
{
    if (!linearLight)
    {
        return 255.0 * light;
    }
    return 255.0 *
           (light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
}

/// A pixel of 1 to 4 channels over the background.
void setPixel(LightPicture& picture, int x, int y, const std::uint8_t* pixel, int channels,
              const TileColor& background)
{
    const bool grey = channels < 3;
    const double alpha = channels % 2 == 0 ? pixel[channels - 1] / 255.0 : 1.0;
    double* to = picture.at(x, y);
    for (int c = 0; c < std::min(picture.channels, 3); ++c)
    {
        const double light = toLight(pixel[grey ? 0 : c], picture.linearLight) * alpha;
        // Translucent pixels are laid over the background as light, whatever averages.
        const double over = toCode(toLight(pixel[grey ? 0 : c], true) * alpha +
                                       toLight(background[c], true) * (1.0 - alpha),
                                   true);
        to[c] = picture.channels == 4 || alpha == 1.0
                    ? light
                    : toLight(std::lround(over), picture.linearLight);
    }
    if (picture.channels == 4)
    {
        to[3] = alpha;
    }
}

} // namespace

std::array<double, 4> LightPicture::code(int x, int y) const
{
    std::array<double, 4> result{};
    const double* from = at(x, y);
    const double alpha = channels == 4 ? from[3] : 1.0;
    for (int c = 0; c < std::min(channels, 3); ++c)
    {
        result[c] = alpha > 0.0 ? toCode(from[c] / alpha, linearLight) : 0.0;
    }
    result[3] = 255.0 * alpha;
    return result;
}

LightPicture paintReference(const AtlasLayout& layout, const std::vector<Pixels>& photos,
                            int channels, const TileColor& background, bool linearLight)
{
    LightPicture picture{int(layout.width), int(layout.height), channels, linearLight, {}};
    picture.values.resize(std::size_t(picture.width) * picture.height * channels);
    for (int y = 0; y < picture.height; ++y)
    {
        for (int x = 0; x < picture.width; ++x)
        {
            setPixel(picture, x, y, background.data(), channels == 4 ? 4 : 3, background);
        }
    }
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        const Pixels& pixels = photos[i];
        const PixelRect covered = layout.getCovered(layout.photos[i]);
        const PixelRect box = layout.photos[i].getBox();
        for (std::int64_t y = covered.y; y < covered.y + covered.height; ++y)
        {
            for (std::int64_t x = covered.x; x < covered.x + covered.width; ++x)
            {
                const auto column =
                    std::clamp(x - layout.photos[i].x, box.x, box.x + box.width - 1);
                const auto row = std::clamp(y - layout.photos[i].y, box.y, box.y + box.height - 1);
                setPixel(picture, int(x), int(y),
                         pixels.row(pixels.height - 1 - int(row)) + column * pixels.channels,
                         pixels.channels, background);
            }
        }
    }
    return picture;
}

LightPicture halveReference(const LightPicture& fine)
{
    LightPicture coarse{
        (fine.width + 1) / 2, (fine.height + 1) / 2, fine.channels, fine.linearLight, {}};
    coarse.values.resize(std::size_t(coarse.width) * coarse.height * coarse.channels);
    for (int y = 0; y < coarse.height; ++y)
    {
        for (int x = 0; x < coarse.width; ++x)
        {
            for (int c = 0; c < coarse.channels; ++c)
            {
                double sum = 0.0;
                for (int i = 0; i < 4; ++i)
                {
                    sum += fine.at(std::min(2 * x + i % 2, fine.width - 1),
                                   std::min(2 * y + i / 2, fine.height - 1))[c];
                }
                coarse.at(x, y)[c] = sum / 4.0;
            }
        }
    }
    return coarse;
}

double differenceOf(const Pixels& tile, const PixelRect& area, const LightPicture& level)
{
    if (tile.width != area.width || tile.height != area.height || tile.channels != level.channels)
    {
        return 256.0;
    }
    double worst = 0.0;
    for (int y = 0; y < tile.height; ++y)
    {
        for (int x = 0; x < tile.width; ++x)
        {
            const auto expected =
                level.code(int(std::clamp<std::int64_t>(area.x + x, 0, level.width - 1)),
                           int(std::clamp<std::int64_t>(area.y + y, 0, level.height - 1)));
            const std::uint8_t* pixel = tile.row(tile.height - 1 - y) + x * tile.channels;
            for (int c = 0; c < tile.channels; ++c)
            {
                // What does not cover has no colour.
                if (c == 3 || expected[3] > 0.0)
                {
                    worst = std::max(worst, std::abs(pixel[c] - expected[c]));
                }
            }
        }
    }
    return worst;
}

LightPicture readLevel(const TileReader& reader, int level, int channels,
                       const TileColor& background, bool linearLight)
{
    const TileGrid& grid = reader.getSettings().grid;
    LightPicture picture{
        int(grid.getWidth(level)), int(grid.getHeight(level)), channels, linearLight, {}};
    picture.values.resize(std::size_t(picture.width) * picture.height * channels);
    ExtractSettings settings;
    settings.channels = channels;
    settings.background = background;
    int y = 0;
    readRegion(reader, level, {0, 0, picture.width, picture.height}, settings,
               [&](const std::uint8_t* row)
               {
                   for (int x = 0; x < picture.width; ++x)
                   {
                       setPixel(picture, x, y, row + x * channels, channels, background);
                   }
                   ++y;
               });
    return picture;
}

} // namespace osgPagedTexture
