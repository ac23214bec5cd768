// SPDX-License-Identifier: MIT
#pragma once
// BC1. Endpoints by principal axis and least squares.

#include "ColorBlock.inl"

namespace
{

/// Two ends on the grid of 5, 6 and 5 bits, as whole numbers in floats.
struct Ends
{
    Color<3> first, second;
};

constexpr float Steps[3] = {31.0f, 63.0f, 31.0f};

inline Color<3> toGrid(const Color<3>& color)
{
    Color<3> grid;
    for (int i = 0; i < 3; ++i)
        grid.c[i] = toFloats(
            toInts(clamped(color.c[i] * (Steps[i] / 255.0f) + (Middle * Steps[i] / 255.0f + 0.5f),
                           0.5f, Steps[i] + 0.5f)));
    return grid;
}

/// What the grid's number means, 0 to 255 from the middle: its bits, repeated.
inline Color<3> fromGrid(const Color<3>& grid)
{
    Color<3> color;
    for (int i = 0; i < 3; ++i)
    {
        const Ints bits = toInts(grid.c[i]);
        color.c[i] =
            toFloats(i == 1 ? (bits << 2) | (bits >> 4) : (bits << 3) | (bits >> 2)) - Middle;
    }
    return color;
}

/// A way to encode the block. With n thirds of the way from the first end to the second for each
/// texel, its error and the best ends for these n follow from few sums.
struct ColorFit
{
    Ends ends;
    Ints indices;          ///< 2 bits a texel: n.
    Floats error;          ///< 9 times the squared one.
    Floats thirds, square; ///< Sums of n, n * n.
    Color<3> toSecond;     ///< Sum of n * texel.
};

/// Sums over the texels of (3 - n)^2, n (3 - n), n^2, and of (3 - n) * texel.
struct Normals
{
    Floats aa, ab, bb;
    Color<3> toFirst;

    Normals(const ColorBlock& block, const ColorFit& fit)
        : aa(144.0f - fit.thirds * 6.0f + fit.square), ab(fit.thirds * 3.0f - fit.square),
          bb(fit.square), toFirst(block.sum * all(3.0f) - fit.toSecond)
    {
    }
};

inline void assign(const ColorBlock& block, ColorFit& fit)
{
    const Color<3> first = fromGrid(fit.ends.first), second = fromGrid(fit.ends.second);
    const Color<3> along = second - first;
    const Floats length = dot(along, along);
    const Color<3> axis = along * (3.0f / (length + 1e-9f));
    const Floats start = 0.5f - dot(first, axis);
    fit.indices = Ints{};
    fit.thirds = fit.square = all(0.0f);
    fit.toSecond = uniform<3>(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        const Ints index = toInts(clamped(dot(block.texel[k], axis) + start, 0.0f, 3.49f));
        const Floats n = toFloats(index);
        fit.indices |= index << (2 * k);
        fit.thirds += n;
        fit.square += n * n;
        fit.toSecond = fit.toSecond + block.texel[k] * n;
    }
    const Normals sums(block, fit);
    fit.error = block.squares * 9.0f + dot(first, first) * sums.aa + dot(second, second) * sums.bb +
                dot(first, second) * sums.ab * 2.0f -
                (dot(first, sums.toFirst) + dot(second, fit.toSecond)) * 6.0f;
}

/// The best ends for how the texels are shared out; where all are at one place the ends stay.
inline Ends refine(const ColorBlock& block, const ColorFit& fit)
{
    const Normals sums(block, fit);
    const Floats determinant = sums.aa * sums.bb - sums.ab * sums.ab;
    const Ints valid = determinant > all(0.5f); // a whole number
    const Floats scale = 3.0f / (valid ? determinant : all(1.0f));
    const Color<3> first = toGrid((sums.toFirst * sums.bb - fit.toSecond * sums.ab) * scale);
    const Color<3> second = toGrid((fit.toSecond * sums.aa - sums.toFirst * sums.ab) * scale);
    return {select(valid, first, fit.ends.first), select(valid, second, fit.ends.second)};
}

inline void keepBetter(const ColorFit& fit, ColorFit& best)
{
    const Ints better = fit.error < best.error;
    best.ends.first = select(better, fit.ends.first, best.ends.first);
    best.ends.second = select(better, fit.ends.second, best.ends.second);
    best.indices = better ? fit.indices : best.indices;
    best.error = better ? fit.error : best.error;
    best.thirds = better ? fit.thirds : best.thirds;
    best.square = better ? fit.square : best.square;
    best.toSecond = select(better, fit.toSecond, best.toSecond);
}

/// For each value of 8 bits the two numbers of a grid whose point at a third of the way is nearest.
struct OneColorTable
{
    std::uint8_t ends[256][2];

    explicit OneColorTable(int bits)
    {
        const int count = 1 << bits;
        const auto expand = [bits](int number)
        { return number << (8 - bits) | number >> (2 * bits - 8); };
        for (int value = 0; value < 256; ++value)
        {
            int best = 1 << 30;
            for (int i = 0; i < count; ++i)
                for (int j = 0; j < count; ++j)
                {
                    const int a = expand(i), b = expand(j);
                    const int wrong = 2 * a + b - 3 * value, spread = a < b ? b - a : a - b;
                    // In hundredths of a third; processors round differently, and the more so the
                    // farther the ends are apart.
                    const int cost = 100 * (wrong < 0 ? -wrong : wrong) + 9 * spread;
                    if (cost < best)
                    {
                        best = cost;
                        ends[value][0] = static_cast<std::uint8_t>(i);
                        ends[value][1] = static_cast<std::uint8_t>(j);
                    }
                }
        }
    }
};

/// Blocks of almost one colour: ends around it that have it at a third of their way. Tried where
/// the palette found so far is no nearer to the texels than their mean.
inline void tryOneColor(const ColorBlock& block, ColorFit& best)
{
    const Ints worthIt = best.error > block.spread * 9.0f;
    if (!any(worthIt))
        return;
    static const OneColorTable tables[2] = {OneColorTable(5), OneColorTable(6)};
    ColorFit fit = best;
    for (int i = 0; i < 3; ++i)
    {
        const Ints mean = toInts(block.sum.c[i] * (1.0f / 16.0f) + (Middle + 0.5f));
        for (int lane = 0; lane < Lanes; ++lane)
        {
            const std::uint8_t* ends = tables[i == 1].ends[mean[lane]];
            fit.ends.first.c[i][lane] = ends[0];
            fit.ends.second.c[i][lane] = ends[1];
        }
    }
    assign(block, fit);
    // What a lane gets must not depend on the others.
    fit.error = worthIt ? fit.error : all(1e30f);
    keepBetter(fit, best);
}

inline Ends endsAlong(const ColorBlock& block)
{
    Floats from = all(1e30f), to = all(-1e30f);
    for (int k = 0; k < 16; ++k)
    {
        const Floats along = dot(block.texel[k], block.axis);
        from = lesser(from, along);
        to = greater(to, along);
    }
    const Color<3> mean = block.sum * all(1.0f / 16.0f);
    const Floats middle = dot(mean, block.axis), margin = (to - from) * (1.0f / 16.0f);
    const Color<3> unit = block.axis * (1.0f / greater(dot(block.axis, block.axis), all(1e-9f)));
    return {toGrid(mean + unit * (from + margin - middle)),
            toGrid(mean + unit * (to - margin - middle))};
}

inline ColorFit fitColor(const ColorBlock& block, int refinements)
{
    ColorFit best;
    best.ends = endsAlong(block);
    assign(block, best);
    for (int step = 0; step < refinements; ++step)
    {
        ColorFit fit;
        fit.ends = refine(block, best);
        assign(block, fit);
        keepBetter(fit, best);
    }
    tryOneColor(block, best);
    return best;
}

} // namespace
