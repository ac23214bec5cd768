// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>

/// Pictures whose texels are known, and how much two differ.
namespace blockSamples
{

using osgPagedTexture::Pixels;
using Texel = std::function<int(int x, int y, int channel)>;

inline Pixels make(int width, int height, int channels, const Texel& texel)
{
    Pixels pixels(width, height, channels);
    std::size_t at = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                pixels.bytes[at++] = static_cast<std::uint8_t>(texel(x, y, c));
    return pixels;
}

/// A number of 0 to 2^32 - 1 that belongs to a place, the same everywhere.
inline std::uint32_t hash(int x, int y, int c)
{
    std::uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ c * 0xC2B2AE3Du;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return h ^ h >> 15;
}

/// The eight kinds that break encoders.
inline Pixels solidBlocks() // one colour a block
{
    return make(512, 512, 3, [](int x, int y, int c) { return hash(x / 4, y / 4, c) & 255; });
}

inline Pixels lowContrast() // a colour a block, and two steps up and down
{
    return make(512, 512, 3,
                [](int x, int y, int c)
                { return 2 + hash(x / 4, y / 4, c) % 252 + int(hash(x, y, c) % 5) - 2; });
}

inline Pixels twoColors() // two colours a block
{
    return make(512, 512, 3,
                [](int x, int y, int c)
                { return hash(2 * (x / 4) + (hash(x, y, 7) & 1), y / 4, c) & 255; });
}

inline Pixels blackAndWhite() // letters of one bit
{
    return make(512, 512, 3, [](int x, int y, int) { return hash(x / 2, y / 3, 5) & 1 ? 255 : 0; });
}

inline Pixels gradient()
{
    return make(512, 512, 3,
                [](int x, int y, int c) { return c == 0   ? x / 2
                                                 : c == 1 ? y / 2
                                                          : (x + y) / 4; });
}

inline Pixels veryDark() // 0 to 3
{
    return make(512, 512, 3, [](int x, int y, int c) { return hash(x, y, c) & 3; });
}

inline Pixels noise()
{
    return make(512, 512, 3, [](int x, int y, int c) { return hash(x, y, c) & 255; });
}

/// Waves of several lengths with a little noise: as smooth and as sharp as photographs.
inline Pixels photograph(int width, int height)
{
    return make(width, height, 3,
                [](int x, int y, int c)
                {
                    const double base = 120 + 60 * std::sin(x * 0.031 + c) * std::cos(y * 0.043) +
                                        30 * std::sin((x + 2 * y) * 0.11 + 2 * c) +
                                        20 * std::sin((3 * x - y) * 0.37);
                    return int(std::min(255.0, std::max(0.0, base + hash(x, y, 0) % 9)));
                });
}

/// In decibels over all values; infinite where they are equal, 0 where the sizes differ.
inline double psnr(const Pixels& a, const Pixels& b)
{
    if (a.bytes.size() != b.bytes.size() || a.bytes.empty())
        return 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.bytes.size(); ++i)
        sum += std::pow(double(a.bytes[i]) - b.bytes[i], 2);
    return sum == 0.0 ? std::numeric_limits<double>::infinity()
                      : 10.0 * std::log10(255.0 * 255.0 * a.bytes.size() / sum);
}

} // namespace blockSamples
