// SPDX-License-Identifier: MIT
// The encoder of BC1.

#include "ClusterFit.inl"
#include "ColorFit.inl"

namespace
{

inline Ints packed(const Color<3>& grid)
{
    return toInts(grid.c[0]) << 11 | toInts(grid.c[1]) << 5 | toInts(grid.c[2]);
}

/// Thirds of the way to BC1's order of palette: first, second, one third, two thirds.
inline void writeColors(const ColorFit& fit, int lanes, std::uint8_t* out, int stride)
{
    const Ints ones = Ints{} + 0x55555555;
    const Ints first = packed(fit.ends.first), second = packed(fit.ends.second);
    const Ints low = fit.indices & ones, high = (fit.indices >> 1) & ones;
    // The larger comes first: the four-colour mode. Equal ends have one colour.
    const Ints swaps = first < second, differ = first != second;
    const Ints codes = ((high ^ (swaps & ones)) | (low ^ high) << 1) & differ;
    const Ints ends = swaps ? second | first << 16 : first | second << 16;
    for (int lane = 0; lane < lanes; ++lane)
    {
        const std::uint32_t words[2] = {std::uint32_t(ends[lane]), std::uint32_t(codes[lane])};
        std::memcpy(out + std::size_t(lane) * stride, words, sizeof(words));
    }
}

void encodeColor(const std::uint32_t* blocks, int count, int refinements, std::uint8_t* out,
                 int stride)
{
    for (int first = 0; first < count; first += Lanes)
    {
        ColorBlock block;
        load(blocks + 16 * std::size_t(first), block);
        ColorFit fit = fitColor(block, refinements < 0 ? 2 : refinements);
        if (refinements < 0)
            tryClusters(block, fit);
        writeColors(fit, count - first < Lanes ? count - first : Lanes,
                    out + std::size_t(first) * stride, stride);
    }
}

} // namespace
