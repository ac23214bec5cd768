// SPDX-License-Identifier: MIT
// BC1. Endpoints by principal axis and least squares, or by cluster fit (S. Brown, "DXT Compression
// Techniques", 2006): the order of the texels along the axis is kept, and all ways to cut it into
// four clusters are tried.

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
        grid.c[i] = truncated(clamped(color.c[i], 0.0f, 255.0f) * (Steps[i] / 255.0f) + 0.5f);
    return grid;
}

/// What the grid's number means, 0 to 255: its bits, repeated.
inline Color<3> fromGrid(const Color<3>& grid)
{
    Color<3> color;
    for (int i = 0; i < 3; ++i)
    {
        const Ints bits = toInts(grid.c[i]);
        color.c[i] = toFloats(i == 1 ? (bits << 2) | (bits >> 4) : (bits << 3) | (bits >> 2));
    }
    return color;
}

/// A way to encode the block, with its squared error.
struct ColorFit
{
    Ends ends;
    Ints indices; ///< 2 bits a texel: thirds of the way from first to second.
    Floats error;
    Floats weights[16];
};

inline void assign(const Texels<3>& texels, ColorFit& fit)
{
    const Color<3> first = fromGrid(fit.ends.first);
    const Color<3> along = fromGrid(fit.ends.second) - first;
    const Floats scale = all(3.0f) / (dot(along, along) + 1e-9f);
    const Floats start = dot(first, along);
    fit.error = all(0.0f);
    fit.indices = Ints{};
    for (int k = 0; k < 16; ++k)
    {
        const Floats place = (dot(texels.texel[k], along) - start) * scale + 0.5f;
        const Ints index = toInts(clamped(place, 0.0f, 3.49f));
        fit.weights[k] = toFloats(index) * (1.0f / 3.0f);
        const Color<3> wrong = first + along * fit.weights[k] - texels.texel[k];
        fit.error += dot(wrong, wrong);
        fit.indices |= index << (2 * k);
    }
}

inline void keepBetter(const ColorFit& fit, ColorFit& best)
{
    const Ints better = fit.error < best.error;
    best.ends.first = select(better, fit.ends.first, best.ends.first);
    best.ends.second = select(better, fit.ends.second, best.ends.second);
    best.indices = better ? fit.indices : best.indices;
    best.error = better ? fit.error : best.error;
    for (int k = 0; k < 16; ++k)
        best.weights[k] = better ? fit.weights[k] : best.weights[k];
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

/// Blocks of almost one colour: ends around it that have it at a third of their way.
inline void tryOneColor(const Texels<3>& texels, ColorFit& best)
{
    const Color<3> range = texels.high - texels.low;
    const Ints narrow =
        (range.c[0] < all(13.0f)) & (range.c[1] < all(13.0f)) & (range.c[2] < all(13.0f));
    if (!any(narrow))
        return;
    static const OneColorTable tables[2] = {OneColorTable(5), OneColorTable(6)};
    ColorFit fit = best;
    for (int i = 0; i < 3; ++i)
    {
        const Ints mean = toInts(texels.mean.c[i] + 0.5f);
        for (int lane = 0; lane < Lanes; ++lane)
        {
            const std::uint8_t* ends = tables[i == 1].ends[mean[lane]];
            fit.ends.first.c[i][lane] = ends[0];
            fit.ends.second.c[i][lane] = ends[1];
        }
    }
    assign(texels, fit);
    // What a lane gets must not depend on the others.
    fit.error = narrow ? fit.error : all(1e30f);
    keepBetter(fit, best);
}

inline ColorFit fitColor(const Texels<3>& texels, const Color<3>& axis, int refinements)
{
    Color<3> first, second;
    endsAlong(texels, axis, 1.0f / 16.0f, first, second);
    ColorFit best;
    best.ends = {toGrid(first), toGrid(second)};
    assign(texels, best);
    for (int step = 0; step < refinements; ++step)
    {
        ColorFit fit;
        leastSquares(texels, best.weights, first, second);
        fit.ends = {toGrid(first), toGrid(second)};
        assign(texels, fit);
        keepBetter(fit, best);
    }
    tryOneColor(texels, best);
    return best;
}

/// sums[k]: of the first k texels in their order along the axis.
inline void sortedSums(const Texels<3>& texels, const Color<3>& axis, Color<3>* sums)
{
    Floats along[16];
    Color<3> sorted[16];
    for (int k = 0; k < 16; ++k)
    {
        along[k] = dot(texels.texel[k], axis);
        sorted[k] = texels.texel[k];
    }
    // Batcher's odd-even merge sort: the same comparisons in all lanes.
    for (int p = 1; p < 16; p += p)
        for (int k = p; k > 0; k /= 2)
            for (int j = k % p; j + k < 16; j += 2 * k)
                for (int i = 0; i < k && i + j + k < 16; ++i)
                    if ((i + j) / (2 * p) == (i + j + k) / (2 * p))
                    {
                        const int a = i + j, b = a + k;
                        const Ints swaps = along[b] < along[a];
                        const Floats farther = swaps ? along[a] : along[b];
                        along[a] = swaps ? along[b] : along[a];
                        along[b] = farther;
                        const Color<3> other = select(swaps, sorted[a], sorted[b]);
                        sorted[a] = select(swaps, sorted[b], sorted[a]);
                        sorted[b] = other;
                    }
    sums[0] = uniform<3>(0.0f);
    for (int k = 0; k < 16; ++k)
        sums[k + 1] = sums[k] + sorted[k];
}

inline void tryClusters(const Texels<3>& texels, const Color<3>& axis, ColorFit& best)
{
    Color<3> sums[17];
    sortedSums(texels, axis, sums);
    ColorFit fit = best;
    Floats least =
        all(1e30f); // without the sum of squares of the texels, which is the same for all
    for (int i = 0; i <= 16; ++i)
        for (int j = i; j <= 16; ++j)
            for (int k = j; k <= 16; ++k)
            {
                const float aa = i + (j - i) * (4.0f / 9.0f) + (k - j) * (1.0f / 9.0f);
                const float bb = 16 - k + (k - j) * (4.0f / 9.0f) + (j - i) * (1.0f / 9.0f);
                const float ab = (k - i) * (2.0f / 9.0f);
                const float determinant = aa * bb - ab * ab;
                if (determinant < 1e-3f) // one cluster: one colour
                    continue;
                const float scale = 1.0f / determinant;
                const Color<3> ax = (sums[i] + sums[j] + sums[k]) * all(1.0f / 3.0f);
                const Color<3> bx = sums[16] - ax;
                Ends ends;
                ends.first = toGrid((ax * all(bb) - bx * all(ab)) * all(scale));
                ends.second = toGrid((bx * all(aa) - ax * all(ab)) * all(scale));
                const Color<3> a = fromGrid(ends.first), b = fromGrid(ends.second);
                const Floats error = dot(a, a) * aa + dot(b, b) * bb + dot(a, b) * (2.0f * ab) -
                                     (dot(a, ax) + dot(b, bx)) * 2.0f;
                const Ints better = error < least;
                least = better ? error : least;
                fit.ends.first = select(better, ends.first, fit.ends.first);
                fit.ends.second = select(better, ends.second, fit.ends.second);
            }
    assign(texels, fit);
    keepBetter(fit, best);
}

/// Thirds of the way to BC1's order of palette: first, second, one third, two thirds.
inline void writeColor(std::uint32_t first, std::uint32_t second, std::uint32_t thirds,
                       std::uint8_t* out)
{
    const std::uint32_t ones = 0x55555555u;
    const std::uint32_t low = thirds & ones, high = (thirds >> 1) & ones;
    std::uint32_t codeLow = high, codeHigh = low ^ high;
    if (first < second) // the larger comes first: the four-colour mode
    {
        const std::uint32_t other = first;
        first = second;
        second = other;
        codeLow = ~codeLow & ones;
    }
    else if (first == second)
        codeLow = codeHigh = 0;
    const std::uint32_t codes = codeLow | codeHigh << 1;
    const std::uint8_t bytes[8] = {std::uint8_t(first),       std::uint8_t(first >> 8),
                                   std::uint8_t(second),      std::uint8_t(second >> 8),
                                   std::uint8_t(codes),       std::uint8_t(codes >> 8),
                                   std::uint8_t(codes >> 16), std::uint8_t(codes >> 24)};
    std::memcpy(out, bytes, sizeof(bytes));
}

inline Ints packed(const Color<3>& grid)
{
    return toInts(grid.c[0]) << 11 | toInts(grid.c[1]) << 5 | toInts(grid.c[2]);
}

void encodeColor(const std::uint8_t* blocks, int count, int refinements, std::uint8_t* out,
                 int stride)
{
    for (int block = 0; block < count; block += Lanes)
    {
        const int lanes = count - block < Lanes ? count - block : Lanes;
        Texels<3> texels;
        load(blocks + 64 * std::size_t(block), lanes, texels);
        const Color<3> axis = principalAxis(texels);
        ColorFit fit = fitColor(texels, axis, refinements < 0 ? 2 : refinements);
        if (refinements < 0)
            tryClusters(texels, axis, fit);
        const Ints first = packed(fit.ends.first), second = packed(fit.ends.second);
        for (int lane = 0; lane < lanes; ++lane)
            writeColor(first[lane], second[lane], fit.indices[lane],
                       out + std::size_t(block + lane) * stride);
    }
}

} // namespace
