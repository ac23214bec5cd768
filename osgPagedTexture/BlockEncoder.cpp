// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockEncoder.h>

#include <osgPagedTexture/BlockKernels.h>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

struct Rgba
{
    std::uint8_t c[4];
};

Rgba texelAt(const Pixels& pixels, int x, int y)
{
    const std::uint8_t* p = pixels.row(y) + std::size_t(x) * pixels.channels;
    switch (pixels.channels)
    {
    case 1:
        return {{p[0], p[0], p[0], 255}};
    case 2:
        return {{p[0], p[0], p[0], p[1]}};
    case 3:
        return {{p[0], p[1], p[2], 255}};
    default:
        return {{p[0], p[1], p[2], p[3]}};
    }
}

/// Sixteen RGBA for each block of one row of blocks.
void gather(const Pixels& pixels, int blockRow, std::vector<std::uint8_t>& texels)
{
    const int blocks = (pixels.width + 3) / 4;
    texels.resize(std::size_t(blocks) * 64);
    for (int y = 0; y < 4; ++y)
    {
        const int row = std::min(4 * blockRow + y, pixels.height - 1);
        const std::uint8_t* source = pixels.row(row);
        std::uint8_t* line = texels.data() + 16 * y;
        const int whole = pixels.width / 4;
        for (int block = 0; block < whole; ++block, line += 64)
        {
            if (pixels.channels == 4)
                std::memcpy(line, source + 16 * std::size_t(block), 16);
            else if (pixels.channels == 3)
                for (int x = 0; x < 4; ++x)
                {
                    const std::uint8_t* p = source + 3 * (4 * std::size_t(block) + x);
                    const std::uint8_t texel[4] = {p[0], p[1], p[2], 255};
                    std::memcpy(line + 4 * x, texel, 4);
                }
            else
                for (int x = 0; x < 4; ++x)
                    std::memcpy(line + 4 * x, texelAt(pixels, 4 * block + x, row).c, 4);
        }
        if (whole < blocks)
            for (int x = 0; x < 4; ++x)
                std::memcpy(line + 4 * x,
                            texelAt(pixels, std::min(4 * whole + x, pixels.width - 1), row).c, 4);
    }
}

/// Texels that nobody sees take the mean colour of the others, so that no colour is fitted to them.
void colorUnseen(std::vector<std::uint8_t>& texels)
{
    for (std::size_t at = 0; at < texels.size(); at += 64)
    {
        std::uint8_t* block = texels.data() + at;
        int seen = 0, sum[3] = {};
        for (int k = 0; k < 16; ++k)
            if (block[4 * k + 3])
            {
                ++seen;
                for (int c = 0; c < 3; ++c)
                    sum[c] += block[4 * k + c];
            }
        for (int k = 0; seen && k < 16; ++k)
            if (!block[4 * k + 3])
                for (int c = 0; c < 3; ++c)
                    block[4 * k + c] = static_cast<std::uint8_t>((sum[c] + seen / 2) / seen);
    }
}

void pickChannel(const std::vector<std::uint8_t>& texels, int channel,
                 std::vector<std::uint8_t>& values)
{
    values.resize(texels.size() / 4);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = texels[4 * i + channel];
}

const BlockKernels& kernelsOf([[maybe_unused]] Instructions instructions)
{
#ifdef OSGPAGEDTEXTURE_X86
    const Instructions wanted = std::min(instructions, bestInstructions());
    if (wanted == Instructions::Avx512)
        return avx512Kernels;
    if (wanted == Instructions::Avx2)
        return avx2Kernels;
#endif
    return baselineKernels;
}

std::vector<std::uint8_t> toPlain(const Pixels& pixels, int channels)
{
    std::vector<std::uint8_t> bytes(std::size_t(pixels.width) * pixels.height * channels);
    std::uint8_t* out = bytes.data();
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x, out += channels)
        {
            const Rgba texel = texelAt(pixels, x, y);
            std::memcpy(out, texel.c, channels);
            if (channels == 2) // grey and alpha, or the first two of several
                out[1] = pixels.channels == 1   ? 255
                         : pixels.channels == 2 ? texel.c[3]
                                                : texel.c[1];
        }
    return bytes;
}

} // namespace

Instructions bestInstructions()
{
#ifdef OSGPAGEDTEXTURE_X86
    static const Instructions best = []
    {
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
            return Instructions::Avx512;
        return __builtin_cpu_supports("avx2") ? Instructions::Avx2 : Instructions::Baseline;
    }();
    return best;
#else
    return Instructions::Baseline;
#endif
}

std::vector<std::uint8_t> encodeBlocks(const Pixels& pixels, BlockFormat format,
                                       EncodeQuality quality, Instructions instructions)
{
    if (pixels.empty())
        return {};
    if (!isBlocked(format))
        return toPlain(pixels, unitBytes(format));
    const BlockKernels& kernels = kernelsOf(instructions);
    const int refinements = quality == EncodeQuality::Best ? -1 : static_cast<int>(quality);
    const int blocks = (pixels.width + 3) / 4, rows = (pixels.height + 3) / 4,
              bytes = unitBytes(format);
    std::vector<std::uint8_t> encoded(levelBytes(format, pixels.width, pixels.height)), texels,
        values;
    const auto channel = [&](int index, std::uint8_t* out)
    {
        pickChannel(texels, index, values);
        kernels.channel(values.data(), blocks, refinements, out, bytes);
    };
    for (int row = 0; row < rows; ++row)
    {
        std::uint8_t* out = encoded.data() + std::size_t(row) * blocks * bytes;
        gather(pixels, row, texels);
        if (format == BlockFormat::BC4 || format == BlockFormat::BC5)
        {
            channel(0, out);
            if (format == BlockFormat::BC5)
                channel(pixels.channels == 2 ? 3 : 1, out + 8);
            continue;
        }
        if (format == BlockFormat::BC3)
            channel(3, out);
        if (format != BlockFormat::BC1 && pixels.hasAlpha())
            colorUnseen(texels);
        if (format == BlockFormat::BC7)
            kernels.mode6(texels.data(), blocks, refinements, out, bytes);
        else
            kernels.color(texels.data(), blocks, refinements, out + bytes - 8, bytes);
    }
    return encoded;
}

} // namespace osgPagedTexture
