// SPDX-License-Identifier: MIT
#pragma once
// BC1 by cluster fit (S. Brown, "DXT Compression Techniques", 2006): the order of the texels along
// the axis is kept, and all ways to cut it into four clusters are tried.

#include "ColorFit.inl"

namespace
{

/// sums[k]: of the first k texels in their order along the axis.
inline void sortedSums(const ColorBlock& block, Color<3>* sums)
{
    Floats along[16];
    Color<3> sorted[16];
    for (int k = 0; k < 16; ++k)
    {
        along[k] = dot(block.texel[k], block.axis);
        sorted[k] = block.texel[k];
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

inline void tryClusters(const ColorBlock& block, ColorFit& best)
{
    Color<3> sums[17];
    sortedSums(block, sums);
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
    assign(block, fit);
    keepBetter(fit, best);
}

} // namespace
