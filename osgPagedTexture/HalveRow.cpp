// SPDX-License-Identifier: MIT
#include <osgPagedTexture/HalveRow.h>

#include <osgPagedTexture/LightTables.h>

#include <cstring>

namespace osgPagedTexture
{

namespace
{

template <int Channels>
void halveLight(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t texels,
                std::uint8_t* half)
{
    const std::uint16_t* const light = LightTables::get().light.data();
    const std::uint8_t* const code = LightTables::get().code.data();
    for (std::size_t x = 0; x < texels; ++x, upper += 2 * Channels, lower += 2 * Channels)
    {
        for (int c = 0; c < Channels; ++c)
        {
            const std::uint32_t sum = std::uint32_t(light[upper[c]]) + light[upper[c + Channels]] +
                                      light[lower[c]] + light[lower[c + Channels]];
            *half++ = code[(sum + 2) >> 2];
        }
    }
}

/// The mean that begins at every sample, which compilers do many at a time, then those of the
/// pairs.
template <int Channels>
void halvePlain(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t texels,
                std::uint8_t* half)
{
    constexpr std::size_t atATime = 128;
    std::uint16_t sums[2 * Channels * atATime];
    std::uint8_t means[2 * Channels * atATime];
    while (texels > 0)
    {
        const std::size_t count = texels < atATime ? texels : atATime;
        const std::size_t samples = 2 * Channels * count;
        for (std::size_t i = 0; i < samples; ++i)
        {
            sums[i] = static_cast<std::uint16_t>(upper[i] + lower[i]);
        }
        for (std::size_t i = 0; i < samples - Channels; ++i)
        {
            means[i] = static_cast<std::uint8_t>((sums[i] + sums[i + Channels] + 2) >> 2);
        }
        // A byte more than a texel of three has: the next one overwrites it.
        constexpr std::size_t moved = Channels == 3 ? 4 : Channels;
        for (std::size_t x = 0; x + 1 < count; ++x, half += Channels)
        {
            std::memcpy(half, means + 2 * Channels * x, moved);
        }
        std::memcpy(half, means + 2 * Channels * (count - 1), Channels);
        half += Channels;
        upper += samples;
        lower += samples;
        texels -= count;
    }
}

/// A texel of four whose colours count as much as they cover.
void blendTexel(const std::uint8_t* const (&pixels)[4], bool linearLight, std::uint8_t* texel)
{
    const LightTables& tables = LightTables::get();
    const std::uint32_t cover = pixels[0][3] + pixels[1][3] + pixels[2][3] + pixels[3][3];
    for (int c = 0; c < 3; ++c)
    {
        std::uint32_t sum = 0;
        for (const std::uint8_t* pixel : pixels)
        {
            // Where nothing covers, the plain mean: what grows into it later has a colour.
            const std::uint32_t weight = cover > 0 ? pixel[3] : 1;
            sum += weight * (linearLight ? tables.light[pixel[c]] : pixel[c]);
        }
        const std::uint32_t weights = cover > 0 ? cover : 4;
        const std::uint32_t mean = (sum + weights / 2) / weights;
        texel[c] = linearLight ? tables.code[mean] : static_cast<std::uint8_t>(mean);
    }
    texel[3] = static_cast<std::uint8_t>((cover + 2) >> 2);
}

bool isOpaque(const std::uint8_t* const (&pixels)[4])
{
    return (pixels[0][3] & pixels[1][3] & pixels[2][3] & pixels[3][3]) == 255;
}

void halveAlpha(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t texels,
                bool linearLight, std::uint8_t* half)
{
    for (std::size_t x = 0; x < texels; ++x, upper += 8, lower += 8, half += 4)
    {
        const std::uint8_t* const pixels[4] = {upper, upper + 4, lower, lower + 4};
        if (!isOpaque(pixels))
        {
            blendTexel(pixels, linearLight, half);
        }
        else if (linearLight)
        {
            halveLight<4>(upper, lower, 1, half);
            half[3] = 255;
        }
        else
        {
            halvePlain<4>(upper, lower, 1, half);
        }
    }
}

void halvePairs(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t texels,
                int channels, bool linearLight, std::uint8_t* half)
{
    if (channels == 4)
    {
        halveAlpha(upper, lower, texels, linearLight, half);
    }
    else if (channels == 3)
    {
        (linearLight ? halveLight<3> : halvePlain<3>)(upper, lower, texels, half);
    }
    else
    {
        (linearLight ? halveLight<1> : halvePlain<1>)(upper, lower, texels, half);
    }
}

} // namespace

void halveRow(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t columns,
              int channels, bool linearLight, std::uint8_t* half)
{
    halvePairs(upper, lower, columns / 2, channels, linearLight, half);
    if (columns % 2 == 1)
    {
        const std::size_t last = (columns - 1) * channels;
        std::uint8_t ends[2][8];
        for (int i = 0; i < 2 * channels; ++i)
        {
            ends[0][i] = upper[last + i % channels];
            ends[1][i] = lower[last + i % channels];
        }
        halvePairs(ends[0], ends[1], 1, channels, linearLight, half + columns / 2 * channels);
    }
}

} // namespace osgPagedTexture
