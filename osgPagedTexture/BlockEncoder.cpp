// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockEncoder.h>

#include <osgPagedTexture/BlockKernels.h>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

/// RGBA, red in the lowest byte.
std::uint32_t texelAt(const std::uint8_t* p, int channels)
{
    const auto pack = [](std::uint32_t r, std::uint32_t g, std::uint32_t b, std::uint32_t a)
    { return r | g << 8 | b << 16 | a << 24; };
    switch (channels)
    {
    case 1:
        return pack(p[0], p[0], p[0], 255);
    case 2:
        return pack(p[0], p[0], p[0], p[1]);
    case 3:
        return pack(p[0], p[1], p[2], 255);
    default:
        return pack(p[0], p[1], p[2], p[3]);
    }
}

std::uint32_t texelAt(const Pixels& pixels, int x, int y)
{
    return texelAt(pixels.row(y) + std::size_t(x) * pixels.channels, pixels.channels);
}

/// The texels of one row of blocks, as the kernels take them.
class BlockRow
{
public:
    BlockRow(const Pixels& pixels, int lanes)
        : _pixels(pixels), _blocks((pixels.width + 3) / 4), _lanes(lanes),
          _words(std::size_t((_blocks + lanes - 1) / lanes) * lanes * 16)
    {
    }

    const std::uint32_t* data() const { return _words.data(); }

    void gather(int row)
    {
        for (int y = 0; y < 4; ++y)
            gatherLine(std::min(4 * row + y, _pixels.height - 1), y);
    }

    /// Texels that nobody sees take the mean colour of the others, so that none is fitted to them.
    void colorUnseen()
    {
        for (int block = 0; block < _blocks; ++block)
        {
            std::uint32_t seen = 0, sum[3] = {};
            for (int k = 0; k < 16; ++k)
                if (const std::uint32_t word = at(block, k); word >> 24)
                {
                    ++seen;
                    for (int c = 0; c < 3; ++c)
                        sum[c] += word >> (8 * c) & 255;
                }
            for (int k = 0; seen && k < 16; ++k)
                if (!(at(block, k) >> 24))
                {
                    at(block, k) = 0;
                    for (int c = 0; c < 3; ++c)
                        at(block, k) |= (sum[c] + seen / 2) / seen << (8 * c);
                }
        }
    }

private:
    std::uint32_t& at(int block, int k)
    {
        return _words[(std::size_t(block / _lanes) * 16 + k) * _lanes + block % _lanes];
    }

    void fourTexels(const std::uint8_t* source, std::uint32_t* words) const
    {
        if (_pixels.channels == 4)
            std::memcpy(words, source, 16);
        else if (_pixels.channels == 3)
        {
            // Twelve bytes as two overlapping numbers.
            std::uint64_t low, high;
            std::memcpy(&low, source, 8);
            std::memcpy(&high, source + 4, 8);
            words[0] = std::uint32_t(low) | 0xff000000u;
            words[1] = std::uint32_t(low >> 24) | 0xff000000u;
            words[2] = std::uint32_t(high >> 16) | 0xff000000u;
            words[3] = std::uint32_t(high >> 40) | 0xff000000u;
        }
        else
            for (int x = 0; x < 4; ++x)
                words[x] = texelAt(source + x * _pixels.channels, _pixels.channels);
    }

    void gatherLine(int row, int y)
    {
        const int whole = _pixels.width / 4;
        const std::uint8_t* source = _pixels.row(row);
        std::uint32_t* line = _words.data() + std::size_t(4 * y) * _lanes;
        for (int block = 0, lane = 0; block < whole; ++block, source += 4 * _pixels.channels)
        {
            std::uint32_t words[4];
            fourTexels(source, words);
            for (int x = 0; x < 4; ++x)
                line[x * _lanes + lane] = words[x];
            if (++lane == _lanes)
            {
                lane = 0;
                line += 16 * _lanes;
            }
        }
        for (int x = 0; whole < _blocks && x < 4; ++x)
            at(whole, 4 * y + x) =
                texelAt(_pixels, std::min(4 * whole + x, _pixels.width - 1), row);
    }

    const Pixels& _pixels;
    int _blocks, _lanes;
    std::vector<std::uint32_t> _words;
};

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
            const std::uint32_t word = texelAt(pixels, x, y);
            const std::uint8_t texel[4] = {std::uint8_t(word), std::uint8_t(word >> 8),
                                           std::uint8_t(word >> 16), std::uint8_t(word >> 24)};
            std::copy(texel, texel + channels, out);
            if (channels == 2) // grey and alpha, or the first two of several
                out[1] = pixels.channels == 1 ? 255 : pixels.channels == 2 ? texel[3] : texel[1];
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
    std::vector<std::uint8_t> encoded(levelBytes(format, pixels.width, pixels.height));
    BlockRow texels(pixels, kernels.lanes);
    for (int row = 0; row < rows; ++row)
    {
        std::uint8_t* out = encoded.data() + std::size_t(row) * blocks * bytes;
        const auto channel = [&](int index, std::uint8_t* to)
        { kernels.channel(texels.data(), blocks, index, refinements, to, bytes); };
        texels.gather(row);
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
            texels.colorUnseen();
        if (format == BlockFormat::BC7)
            kernels.mode6(texels.data(), blocks, refinements, out, bytes);
        else
            kernels.color(texels.data(), blocks, refinements, out + bytes - 8, bytes);
    }
    return encoded;
}

} // namespace osgPagedTexture
