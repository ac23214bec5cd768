// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MakeMipChain.h>

#include <osgPagedTexture/BoxReducer.h>
#include <osgPagedTexture/LightTables.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace osgPagedTexture
{

namespace
{

/// Both sides even, no alpha: the case of nearly all textures, 2x2 texels to one.
template <int Channels> void halveEven(const Pixels& from, bool light, Pixels& to)
{
    const LightTables& tables = LightTables::get();
    for (int y = 0; y < to.height; ++y)
    {
        const std::uint8_t* low = from.row(2 * y);
        const std::uint8_t* high = from.row(2 * y + 1);
        std::uint8_t* out = to.row(y);
        for (int x = 0; x < to.width; ++x, low += 2 * Channels, high += 2 * Channels)
            for (int c = 0; c < Channels; ++c, ++out)
            {
                const std::uint8_t a = low[c], b = low[c + Channels], d = high[c],
                                   e = high[c + Channels];
                if (light)
                    *out = tables.code[(tables.light[a] + tables.light[b] + tables.light[d] +
                                        tables.light[e] + 2u) /
                                       4u];
                else
                    *out = static_cast<std::uint8_t>((a + b + d + e + 2) / 4);
            }
    }
}

void normalize(Pixels& pixels)
{
    if (pixels.channels < 3)
        return;
    for (std::size_t at = 0; at < pixels.bytes.size(); at += pixels.channels)
    {
        std::uint8_t* texel = pixels.bytes.data() + at;
        double v[3], square = 0.0;
        for (int c = 0; c < 3; ++c)
        {
            v[c] = texel[c] / 127.5 - 1.0;
            square += v[c] * v[c];
        }
        if (square < 1e-4) // opposite directions: up
            v[0] = v[1] = 0.0, v[2] = square = 1.0;
        for (int c = 0; c < 3; ++c)
            texel[c] =
                static_cast<std::uint8_t>(std::lround((v[c] / std::sqrt(square) + 1.0) * 127.5));
    }
}

bool isGrey(const Pixels& pixels)
{
    for (std::size_t at = 0; at + 2 < pixels.bytes.size(); at += pixels.channels)
        if (pixels.bytes[at] != pixels.bytes[at + 1] || pixels.bytes[at] != pixels.bytes[at + 2])
            return false;
    return true;
}

bool isOpaque(const Pixels& pixels)
{
    for (std::size_t at = pixels.channels - 1; at < pixels.bytes.size(); at += pixels.channels)
        if (pixels.bytes[at] != 255)
            return false;
    return true;
}

} // namespace

BlockFormat chooseFormat(const Pixels& pixels, TexelUse use, bool best)
{
    if (use == TexelUse::NormalMap)
        return BlockFormat::BC5;
    const bool opaque = !pixels.hasAlpha() || isOpaque(pixels);
    if (opaque && (pixels.channels < 3 || isGrey(pixels)))
        return BlockFormat::BC4;
    if (best)
        return BlockFormat::BC7;
    return opaque ? BlockFormat::BC1 : BlockFormat::BC3;
}

Pixels halve(const Pixels& pixels, TexelUse use)
{
    Pixels half(levelSide(pixels.width, 1), levelSide(pixels.height, 1), pixels.channels);
    const bool light = use == TexelUse::Color;
    const bool even = pixels.width % 2 == 0 && pixels.height % 2 == 0;
    if (even && pixels.channels == 3)
        halveEven<3>(pixels, light, half);
    else if (even && pixels.channels == 1)
        halveEven<1>(pixels, light, half);
    else
    {
        BoxReducer reducer({pixels.width, pixels.channels, double(pixels.width),
                            double(pixels.height), half.width, half.height, light},
                           [&half](const std::uint8_t* row, int y)
                           { std::copy_n(row, half.width * half.channels, half.row(y)); });
        for (int y = 0; y < pixels.height; ++y)
            reducer.add(pixels.row(y));
    }
    if (use == TexelUse::NormalMap)
        normalize(half);
    return half;
}

MipChain makeMipChain(Pixels pixels, int firstLevel, int width, int height, TexelUse use,
                      BlockFormat format, EncodeQuality quality)
{
    if (width < 1 || height < 1 || firstLevel < 0 || pixels.width != levelSide(width, firstLevel) ||
        pixels.height != levelSide(height, firstLevel) || pixels.empty())
        throw std::invalid_argument("pixels of " + std::to_string(pixels.width) + "x" +
                                    std::to_string(pixels.height) + " are not level " +
                                    std::to_string(firstLevel) + " of " + std::to_string(width) +
                                    "x" + std::to_string(height));
    MipChain chain{format, width, height, firstLevel, {}};
    const int count = levelCount(width, height);
    for (int level = firstLevel;; ++level)
    {
        chain.levels.push_back(encodeBlocks(pixels, format, quality));
        if (level + 1 >= count)
            return chain;
        pixels = halve(pixels, use);
    }
}

} // namespace osgPagedTexture
