// SPDX-License-Identifier: MIT
// BC7, mode 6: one line through RGBA with 16 places, ends of 7 bits a channel and one bit that all
// channels of an end share.

namespace
{

struct Mode6Fit
{
    Color<4> first, second; ///< 0 to 255, the shared bit included.
    Floats error;
    Floats steps[16]; ///< 0 to 15.
};

/// The nearest colours with a shared bit of 0 or 1.
inline Color<4> withBit(const Color<4>& color, float bit)
{
    Color<4> result;
    for (int i = 0; i < 4; ++i)
        result.c[i] =
            truncated(clamped((color.c[i] - bit) * 0.5f + 0.5f, 0.0f, 127.0f)) * 2.0f + bit;
    return result;
}

/// The end has the bit set, so that an alpha of 255 is possible there.
inline Ints mustBeOdd(const Texels<4>& texels, const Color<4>& end)
{
    return (texels.high.c[3] == all(255.0f)) & (end.c[3] > all(127.5f));
}

/// Of both bits the one that is nearer.
inline Color<4> nearest(const Texels<4>& texels, const Color<4>& end)
{
    const Color<4> even = withBit(end, 0.0f), odd = withBit(end, 1.0f);
    const Color<4> wrongEven = even - end, wrongOdd = odd - end;
    return select(mustBeOdd(texels, end) | (dot(wrongOdd, wrongOdd) < dot(wrongEven, wrongEven)),
                  odd, even);
}

/// Weight in 64ths of each of 16 places, as the format has them: 0, 4, 9, 13, 17, … 64.
inline Floats weightOf(Floats step)
{
    return truncated((step * 64.0f + 7.5f) * (1.0f / 15.0f));
}

inline void assign(const Texels<4>& texels, Mode6Fit& fit)
{
    const Color<4> along = fit.second - fit.first;
    const Floats scale = all(15.0f) / (dot(along, along) + 1e-9f);
    const Floats start = dot(fit.first, along);
    fit.error = all(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        const Floats place = (dot(texels.texel[k], along) - start) * scale + 0.5f;
        fit.steps[k] = truncated(clamped(place, 0.0f, 15.49f));
        const Floats weight = weightOf(fit.steps[k]);
        for (int i = 0; i < 4; ++i)
        {
            const Floats shown =
                truncated((fit.first.c[i] * 64.0f + along.c[i] * weight + 32.0f) * (1.0f / 64.0f));
            const Floats wrong = shown - texels.texel[k].c[i];
            fit.error += wrong * wrong;
        }
    }
}

inline void keepBetter(const Mode6Fit& fit, Mode6Fit& best)
{
    const Ints better = fit.error < best.error;
    best.first = select(better, fit.first, best.first);
    best.second = select(better, fit.second, best.second);
    best.error = better ? fit.error : best.error;
    for (int k = 0; k < 16; ++k)
        best.steps[k] = better ? fit.steps[k] : best.steps[k];
}

inline Mode6Fit fitMode6(const Texels<4>& texels, int refinements)
{
    Color<4> first, second;
    endsAlong(texels, principalAxis(texels), 1.0f / 64.0f, first, second);
    Mode6Fit best;
    best.first = nearest(texels, first);
    best.second = nearest(texels, second);
    assign(texels, best);
    const int steps = refinements < 0 ? 3 : refinements;
    for (int step = 0; step < steps; ++step)
    {
        Floats weights[16];
        for (int k = 0; k < 16; ++k)
            weights[k] = weightOf(best.steps[k]) * (1.0f / 64.0f);
        leastSquares(texels, weights, first, second);
        Mode6Fit fit;
        fit.first = nearest(texels, first);
        fit.second = nearest(texels, second);
        assign(texels, fit);
        keepBetter(fit, best);
        for (int bits = 0; refinements < 0 && bits < 4; ++bits)
        {
            fit.first = select(mustBeOdd(texels, first), withBit(first, 1.0f),
                               withBit(first, float(bits & 1)));
            fit.second = select(mustBeOdd(texels, second), withBit(second, 1.0f),
                                withBit(second, float(bits >> 1)));
            assign(texels, fit);
            keepBetter(fit, best);
        }
    }
    return best;
}

struct BitWriter
{
    std::uint64_t words[2] = {0, 0};
    int at = 0;

    void add(std::uint32_t value, int bits)
    {
        words[at / 64] |= std::uint64_t(value) << (at % 64);
        if (at % 64 + bits > 64)
            words[at / 64 + 1] |= std::uint64_t(value) >> (64 - at % 64);
        at += bits;
    }
};

inline void writeMode6(const int* first, const int* second, const int* steps, std::uint8_t* out)
{
    // The first texel's highest bit is not stored: it is 0.
    const bool swaps = steps[0] > 7;
    const int *a = swaps ? second : first, *b = swaps ? first : second;
    BitWriter bits;
    bits.add(1u << 6, 7);
    for (int i = 0; i < 4; ++i)
    {
        bits.add(std::uint32_t(a[i]) >> 1, 7);
        bits.add(std::uint32_t(b[i]) >> 1, 7);
    }
    bits.add(a[0] & 1, 1);
    bits.add(b[0] & 1, 1);
    for (int k = 0; k < 16; ++k)
        bits.add(std::uint32_t(swaps ? 15 - steps[k] : steps[k]), k ? 4 : 3);
    for (int i = 0; i < 16; ++i)
        out[i] = std::uint8_t(bits.words[i / 8] >> (8 * (i % 8)));
}

void encodeMode6(const std::uint8_t* blocks, int count, int refinements, std::uint8_t* out,
                 int stride)
{
    for (int block = 0; block < count; block += Lanes)
    {
        const int lanes = count - block < Lanes ? count - block : Lanes;
        Texels<4> texels;
        load(blocks + 64 * std::size_t(block), lanes, texels);
        const Mode6Fit fit = fitMode6(texels, refinements);
        for (int lane = 0; lane < lanes; ++lane)
        {
            int first[4], second[4], steps[16];
            for (int i = 0; i < 4; ++i)
            {
                first[i] = static_cast<int>(fit.first.c[i][lane]);
                second[i] = static_cast<int>(fit.second.c[i][lane]);
            }
            for (int k = 0; k < 16; ++k)
                steps[k] = static_cast<int>(fit.steps[k][lane]);
            writeMode6(first, second, steps, out + std::size_t(block + lane) * stride);
        }
    }
}

} // namespace
