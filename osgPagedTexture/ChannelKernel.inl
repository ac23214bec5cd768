// SPDX-License-Identifier: MIT
// BC4: eight values between two ends, or six and, exactly, 0 and 255.

namespace
{

struct ChannelFit
{
    Floats low, high; ///< Whole numbers.
    Floats error;
    Floats steps[16]; ///< From low to high: sevenths, or fifths; 6 and 7 are 0 and 255.
};

inline void assignSevenths(const Floats* values, ChannelFit& fit)
{
    const Floats range = fit.high - fit.low;
    const Floats scale = all(7.0f) / greater(range, all(1.0f));
    fit.error = all(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        fit.steps[k] = truncated(clamped((values[k] - fit.low) * scale + 0.5f, 0.0f, 7.0f));
        const Floats wrong = fit.low + range * (fit.steps[k] * (1.0f / 7.0f)) - values[k];
        fit.error += wrong * wrong;
    }
}

inline ChannelFit fitSevenths(const Floats* values, Floats low, Floats high, int refinements)
{
    ChannelFit best;
    best.low = low;
    best.high = high;
    assignSevenths(values, best);
    for (int step = 0; step < refinements; ++step)
    {
        Texels<1> texels;
        Floats weights[16];
        for (int k = 0; k < 16; ++k)
        {
            texels.texel[k].c[0] = values[k];
            weights[k] = best.steps[k] * (1.0f / 7.0f);
        }
        Color<1> first{{best.low}}, second{{best.high}};
        leastSquares(texels, weights, first, second);
        ChannelFit fit;
        fit.low = truncated(clamped(first.c[0], 0.0f, 255.0f) + 0.5f);
        fit.high = truncated(clamped(second.c[0], 0.0f, 255.0f) + 0.5f);
        assignSevenths(values, fit);
        const Ints better = (fit.error < best.error) & (fit.low < fit.high);
        best.low = better ? fit.low : best.low;
        best.high = better ? fit.high : best.high;
        best.error = better ? fit.error : best.error;
        for (int k = 0; k < 16; ++k)
            best.steps[k] = better ? fit.steps[k] : best.steps[k];
    }
    return best;
}

/// low > high where all values are 0 or 255.
inline ChannelFit fitFifths(const Floats* values)
{
    ChannelFit fit;
    fit.low = all(255.0f);
    fit.high = all(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        const Ints inner = (values[k] > all(0.0f)) & (values[k] < all(255.0f));
        fit.low = inner ? lesser(fit.low, values[k]) : fit.low;
        fit.high = inner ? greater(fit.high, values[k]) : fit.high;
    }
    const Floats range = fit.high - fit.low;
    const Floats scale = all(5.0f) / greater(range, all(1.0f));
    fit.error = all(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        const Floats step = truncated(clamped((values[k] - fit.low) * scale + 0.5f, 0.0f, 5.0f));
        const Floats wrong = fit.low + range * (step * 0.2f) - values[k];
        const Floats fromTop = all(255.0f) - values[k];
        const Floats square = wrong * wrong, bottom = values[k] * values[k],
                     top = fromTop * fromTop;
        fit.steps[k] = bottom < square ? (bottom < top ? all(6.0f) : all(7.0f))
                                       : (top < square ? all(7.0f) : step);
        fit.error += lesser(square, lesser(bottom, top));
    }
    return fit;
}

/// `fifths`: the other mode, in which the lesser end comes first.
inline void writeChannel(int low, int high, const int* steps, bool fifths, std::uint8_t* out)
{
    std::uint64_t codes = 0;
    for (int k = 0; k < 16; ++k)
    {
        const int step = steps[k], most = fifths ? 5 : 7;
        int code = step;
        if (fifths ? step < 6 : true)
        {
            // From the first end on: fifths go from low to high, sevenths from high to low.
            const int from = fifths ? step : most - step;
            code = from == 0 ? 0 : from == most ? 1 : from + 1;
        }
        codes |= std::uint64_t(code) << (3 * k);
    }
    if (!fifths && low == high)
        codes = 0;
    out[0] = std::uint8_t(fifths ? low : high);
    out[1] = std::uint8_t(fifths ? high : low);
    for (int i = 0; i < 6; ++i)
        out[2 + i] = std::uint8_t(codes >> (8 * i));
}

void encodeChannel(const std::uint8_t* blocks, int count, int refinements, std::uint8_t* out,
                   int stride)
{
    for (int block = 0; block < count; block += Lanes)
    {
        const int lanes = count - block < Lanes ? count - block : Lanes;
        Floats values[16], low = all(255.0f), high = all(0.0f);
        for (int k = 0; k < 16; ++k)
        {
            for (int lane = 0; lane < Lanes; ++lane)
                values[k][lane] = blocks[16 * std::size_t(block + (lane < lanes ? lane : 0)) + k];
            low = lesser(low, values[k]);
            high = greater(high, values[k]);
        }
        const ChannelFit sevenths =
            fitSevenths(values, low, high, refinements < 0 ? 2 : refinements);
        ChannelFit fifths = sevenths;
        Ints better = (low == all(0.0f)) | (high == all(255.0f));
        if (any(better))
        {
            fifths = fitFifths(values);
            better = better & (fifths.error < sevenths.error) & (fifths.low <= fifths.high);
        }
        for (int lane = 0; lane < lanes; ++lane)
        {
            const ChannelFit& fit = better[lane] ? fifths : sevenths;
            int steps[16];
            for (int k = 0; k < 16; ++k)
                steps[k] = static_cast<int>(fit.steps[k][lane]);
            writeChannel(static_cast<int>(fit.low[lane]), static_cast<int>(fit.high[lane]), steps,
                         better[lane] != 0, out + std::size_t(block + lane) * stride);
        }
    }
}

} // namespace
