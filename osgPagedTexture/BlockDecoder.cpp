// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockEncoder.h>

#include <algorithm>
#include <stdexcept>

namespace osgPagedTexture
{

namespace
{

/// Sixteen texels of up to four channels, row by row.
struct Block
{
    std::uint8_t texels[16][4];
};

std::uint64_t read(const std::uint8_t* bytes, int count)
{
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i)
        value |= std::uint64_t(bytes[i]) << (8 * i);
    return value;
}

void decodeColor(const std::uint8_t* bytes, bool opaque, Block& block)
{
    const int ends[2] = {int(read(bytes, 2)), int(read(bytes + 2, 2))};
    const std::uint64_t codes = read(bytes + 4, 4);
    int palette[4][4];
    for (int end = 0; end < 2; ++end)
    {
        const int r = ends[end] >> 11, g = ends[end] >> 5 & 63, b = ends[end] & 31;
        const int color[4] = {r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2, 255};
        std::copy(color, color + 4, palette[end]);
    }
    const bool thirds = opaque || ends[0] > ends[1];
    for (int c = 0; c < 4; ++c)
    {
        const int a = palette[0][c], b = palette[1][c];
        palette[2][c] = thirds ? (2 * a + b + 1) / 3 : (a + b + 1) / 2;
        palette[3][c] = thirds ? (a + 2 * b + 1) / 3 : 0;
    }
    for (int k = 0; k < 16; ++k)
        for (int c = 0; c < 4; ++c)
            block.texels[k][c] = static_cast<std::uint8_t>(palette[codes >> (2 * k) & 3][c]);
}

void decodeChannel(const std::uint8_t* bytes, int channel, Block& block)
{
    const int a = bytes[0], b = bytes[1], steps = a > b ? 7 : 5;
    int palette[8] = {a, b, 0, 0, 0, 0, 0, 255};
    for (int i = 1; i < steps; ++i)
        palette[1 + i] = ((steps - i) * a + i * b + steps / 2) / steps;
    const std::uint64_t codes = read(bytes + 2, 6);
    for (int k = 0; k < 16; ++k)
        block.texels[k][channel] = static_cast<std::uint8_t>(palette[codes >> (3 * k) & 7]);
}

void decodeMode6(const std::uint8_t* bytes, Block& block)
{
    block = {};
    if ((bytes[0] & 127) != 64) // another mode
        return;
    int at = 7;
    const auto next = [&](int bits)
    {
        int value = 0;
        for (int i = 0; i < bits; ++i, ++at)
            value |= (bytes[at / 8] >> (at % 8) & 1) << i;
        return value;
    };
    int ends[2][4];
    for (int c = 0; c < 4; ++c)
        for (auto& end : ends)
            end[c] = next(7) << 1;
    for (auto& end : ends)
        for (int c = 0, bit = next(1); c < 4; ++c)
            end[c] |= bit;
    for (int k = 0; k < 16; ++k)
    {
        const int weight = (next(k ? 4 : 3) * 64 + 7) / 15;
        for (int c = 0; c < 4; ++c)
            block.texels[k][c] = static_cast<std::uint8_t>(
                (ends[0][c] * (64 - weight) + ends[1][c] * weight + 32) >> 6);
    }
}

void decode(const std::uint8_t* bytes, BlockFormat format, Block& block)
{
    switch (format)
    {
    case BlockFormat::BC1:
        return decodeColor(bytes, false, block);
    case BlockFormat::BC3:
        decodeColor(bytes + 8, true, block);
        return decodeChannel(bytes, 3, block);
    case BlockFormat::BC5:
        decodeChannel(bytes + 8, 1, block);
        [[fallthrough]];
    case BlockFormat::BC4:
        return decodeChannel(bytes, 0, block);
    default:
        return decodeMode6(bytes, block);
    }
}

int channelsOf(BlockFormat format)
{
    switch (format)
    {
    case BlockFormat::BC1:
        return 3;
    case BlockFormat::BC3:
    case BlockFormat::BC7:
        return 4;
    case BlockFormat::BC4:
        return 1;
    case BlockFormat::BC5:
        return 2;
    default:
        return unitBytes(format);
    }
}

} // namespace

Pixels decodeBlocks(const std::vector<std::uint8_t>& bytes, BlockFormat format, int width,
                    int height)
{
    if (width < 0 || height < 0 || bytes.size() != levelBytes(format, width, height))
        throw std::invalid_argument(formatName(format) + " of " + std::to_string(width) + "x" +
                                    std::to_string(height) + " has " +
                                    std::to_string(levelBytes(format, width, height)) +
                                    " bytes, not " + std::to_string(bytes.size()));
    Pixels pixels(width, height, channelsOf(format));
    if (!isBlocked(format))
    {
        pixels.bytes = bytes;
        return pixels;
    }
    const std::uint8_t* source = bytes.data();
    for (int y = 0; y < height; y += 4)
        for (int x = 0; x < width; x += 4, source += unitBytes(format))
        {
            Block block;
            decode(source, format, block);
            for (int k = 0; k < 16; ++k)
                if (x + k % 4 < width && y + k / 4 < height)
                    std::copy_n(block.texels[k], pixels.channels,
                                pixels.row(y + k / 4) + std::size_t(x + k % 4) * pixels.channels);
        }
    return pixels;
}

} // namespace osgPagedTexture
