// SPDX-License-Identifier: MIT
#pragma once
// The texels of BC1, their moments and the direction in which they spread most.

namespace
{

/// Texels are taken from the middle of their range: then all sums of a block's squares and products
/// are whole numbers below 2^24, and floats have them exactly.
constexpr float Middle = 128.0f;

/// The texels of one block a lane, and their moments.
struct ColorBlock
{
    Color<3> texel[16];
    Color<3> sum;
    Floats products[6]; ///< Sums of rr, rg, rb, gg, gb, bb.
    Floats squares;     ///< Sum of squares of all channels.
    Floats spread;      ///< The same of what is left without the mean colour.
    Color<3> axis;      ///< In which they spread most, or 0.
};

/// A symmetric matrix in each lane.
struct Symmetric
{
    Floats xx, xy, xz, yy, yz, zz;

    Color<3> operator*(const Color<3>& v) const
    {
        return {{xx * v.c[0] + xy * v.c[1] + xz * v.c[2], xy * v.c[0] + yy * v.c[1] + yz * v.c[2],
                 xz * v.c[0] + yz * v.c[1] + zz * v.c[2]}};
    }
};

inline Symmetric squared(const Symmetric& m)
{
    return {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
            m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
            m.xy * m.xz + m.yy * m.yz + m.yz * m.zz, m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
}

/// The direction in which texels spread most: the fifth power of the covariance, by squaring.
inline void findAxis(ColorBlock& block)
{
    // 16 times the covariance, exactly.
    const Floats* p = block.products;
    const Floats* s = block.sum.c;
    const Floats rr = p[0] * 16.0f - s[0] * s[0], rg = p[1] * 16.0f - s[0] * s[1],
                 rb = p[2] * 16.0f - s[0] * s[2], gg = p[3] * 16.0f - s[1] * s[1],
                 gb = p[4] * 16.0f - s[1] * s[2], bb = p[5] * 16.0f - s[2] * s[2];
    const Floats trace = rr + gg + bb;
    block.spread = trace * (1.0f / 16.0f);
    const Floats scale = 1.0f / greater(trace, all(1.0f));
    Symmetric power = {rr * scale, rg * scale, rb * scale, gg * scale, gb * scale, bb * scale};
    const Ints redMost = (power.xx >= power.yy) & (power.xx >= power.zz);
    const Ints greenMost = power.yy >= power.zz;
    const Color<3> column = select(redMost, Color<3>{{power.xx, power.xy, power.xz}},
                                   select(greenMost, Color<3>{{power.xy, power.yy, power.yz}},
                                          Color<3>{{power.xz, power.yz, power.zz}}));
    power = squared(squared(power));
    block.axis = power * column;
}

inline void load(const std::uint32_t* group, ColorBlock& block)
{
    block.sum = uniform<3>(0.0f);
    for (Floats& product : block.products)
        product = all(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        Ints word;
        std::memcpy(&word, group + std::size_t(k) * Lanes, sizeof(word));
        word ^= 0x808080; // from the middle, with a sign
        const Floats r = toFloats((word << 24) >> 24), g = toFloats((word << 16) >> 24),
                     b = toFloats((word << 8) >> 24);
        block.texel[k] = {{r, g, b}};
        block.sum = block.sum + block.texel[k];
        const Floats products[6] = {r * r, r * g, r * b, g * g, g * b, b * b};
        for (int i = 0; i < 6; ++i)
            block.products[i] += products[i];
    }
    block.squares = block.products[0] + block.products[3] + block.products[5];
    findAxis(block);
}

} // namespace
