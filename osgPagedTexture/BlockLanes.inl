// SPDX-License-Identifier: MIT
// Vectors of one block a lane, and what the kernels do with them. Included in BlockKernels*.cpp,
// each compiled for other instructions, after OSGPAGEDTEXTURE_LANES is defined; all is internal
// there.

#include <cstdint>
#include <cstring>
#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace
{

constexpr int Lanes = OSGPAGEDTEXTURE_LANES;
typedef float Floats __attribute__((vector_size(Lanes * 4)));
typedef std::int32_t Ints __attribute__((vector_size(Lanes * 4)));
typedef std::uint32_t Words __attribute__((vector_size(Lanes * 4)));

inline Floats all(float value)
{
    return Floats{} + value;
}

// a < b ? a : b and a > b ? a : b, for which compilers do not find the instruction.
#if defined(__x86_64__) && OSGPAGEDTEXTURE_LANES == 4
inline Floats lesser(Floats a, Floats b)
{
    return _mm_min_ps(a, b);
}

inline Floats greater(Floats a, Floats b)
{
    return _mm_max_ps(a, b);
}
#elif defined(__x86_64__) && OSGPAGEDTEXTURE_LANES == 8
inline Floats lesser(Floats a, Floats b)
{
    return _mm256_min_ps(a, b);
}

inline Floats greater(Floats a, Floats b)
{
    return _mm256_max_ps(a, b);
}
#elif defined(__x86_64__) && OSGPAGEDTEXTURE_LANES == 16
inline Floats lesser(Floats a, Floats b)
{
    return _mm512_min_ps(a, b);
}

inline Floats greater(Floats a, Floats b)
{
    return _mm512_max_ps(a, b);
}
#else
inline Floats lesser(Floats a, Floats b)
{
    return a < b ? a : b;
}

inline Floats greater(Floats a, Floats b)
{
    return a > b ? a : b;
}
#endif

inline Floats clamped(Floats value, float from, float to)
{
    return lesser(greater(value, all(from)), all(to));
}

inline Floats toFloats(Ints value)
{
    return __builtin_convertvector(value, Floats);
}

/// Towards zero.
inline Ints toInts(Floats value)
{
    return __builtin_convertvector(value, Ints);
}

inline Floats truncated(Floats value)
{
    return toFloats(toInts(value));
}

inline bool any(Ints mask)
{
    std::int32_t found = 0;
    for (int lane = 0; lane < Lanes; ++lane)
        found |= mask[lane];
    return found != 0;
}

/// Channels of a colour in each lane.
template <int N> struct Color
{
    Floats c[N];

    Color operator+(const Color& other) const
    {
        Color sum;
        for (int i = 0; i < N; ++i)
            sum.c[i] = c[i] + other.c[i];
        return sum;
    }
    Color operator-(const Color& other) const
    {
        Color difference;
        for (int i = 0; i < N; ++i)
            difference.c[i] = c[i] - other.c[i];
        return difference;
    }
    Color operator*(Floats factor) const
    {
        Color product;
        for (int i = 0; i < N; ++i)
            product.c[i] = c[i] * factor;
        return product;
    }
};

template <int N> inline Floats dot(const Color<N>& a, const Color<N>& b)
{
    Floats sum = a.c[0] * b.c[0];
    for (int i = 1; i < N; ++i)
        sum += a.c[i] * b.c[i];
    return sum;
}

template <int N> inline Color<N> select(Ints mask, const Color<N>& a, const Color<N>& b)
{
    Color<N> chosen;
    for (int i = 0; i < N; ++i)
        chosen.c[i] = mask ? a.c[i] : b.c[i];
    return chosen;
}

template <int N> inline Color<N> uniform(float value)
{
    Color<N> color;
    for (int i = 0; i < N; ++i)
        color.c[i] = all(value);
    return color;
}

/// The texels of one block a lane.
template <int N> struct Texels
{
    Color<N> texel[16];
    Color<N> low, high, mean;
};

/// Of one group of blocks, see BlockKernels.
template <int N> inline void load(const std::uint32_t* group, Texels<N>& texels)
{
    texels.low = uniform<N>(255.0f);
    texels.high = texels.mean = uniform<N>(0.0f);
    for (int k = 0; k < 16; ++k)
    {
        Ints word;
        std::memcpy(&word, group + std::size_t(k) * Lanes, sizeof(word));
        for (int i = 0; i < N; ++i)
        {
            const Floats value = toFloats((word >> (8 * i)) & 255);
            texels.texel[k].c[i] = value;
            texels.mean.c[i] += value;
            texels.low.c[i] = lesser(texels.low.c[i], value);
            texels.high.c[i] = greater(texels.high.c[i], value);
        }
    }
    texels.mean = texels.mean * all(1.0f / 16.0f);
}

/// The direction in which the texels spread most, by power iterations from the box's diagonal.
template <int N> inline Color<N> principalAxis(const Texels<N>& texels)
{
    Floats covariance[N][N] = {};
    for (int k = 0; k < 16; ++k)
    {
        const Color<N> offset = texels.texel[k] - texels.mean;
        for (int i = 0; i < N; ++i)
            for (int j = i; j < N; ++j)
                covariance[i][j] += offset.c[i] * offset.c[j];
    }
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < i; ++j)
            covariance[i][j] = covariance[j][i];
    Color<N> axis = texels.high - texels.low;
    // The diagonal's signs are those of the covariance with the channel that varies most.
    Floats most = covariance[0][0];
    Color<N> signs;
    for (int j = 0; j < N; ++j)
        signs.c[j] = covariance[0][j];
    for (int i = 1; i < N; ++i)
    {
        const Ints larger = covariance[i][i] > most;
        most = larger ? covariance[i][i] : most;
        for (int j = 0; j < N; ++j)
            signs.c[j] = larger ? covariance[i][j] : signs.c[j];
    }
    for (int i = 0; i < N; ++i)
        axis.c[i] = signs.c[i] < all(0.0f) ? -axis.c[i] : axis.c[i];
    for (int step = 0; step < 4; ++step)
    {
        Color<N> next;
        Floats longest = all(0.0f);
        for (int i = 0; i < N; ++i)
        {
            next.c[i] = axis.c[0] * covariance[i][0];
            for (int j = 1; j < N; ++j)
                next.c[i] += axis.c[j] * covariance[i][j];
            longest = greater(longest, next.c[i] < all(0.0f) ? -next.c[i] : next.c[i]);
        }
        const Ints valid = longest > all(1e-6f);
        const Floats scale = all(1.0f) / (valid ? longest : all(1.0f));
        axis = select(valid, next * scale, axis);
    }
    return axis;
}

/// The ends of the texels' spread along an axis through their mean, moved inwards by `inset` of it.
template <int N>
inline void endsAlong(const Texels<N>& texels, const Color<N>& axis, float inset, Color<N>& first,
                      Color<N>& second)
{
    Floats from = all(1e30f), to = all(-1e30f);
    for (int k = 0; k < 16; ++k)
    {
        const Floats along = dot(texels.texel[k] - texels.mean, axis);
        from = lesser(from, along);
        to = greater(to, along);
    }
    const Floats margin = (to - from) * inset;
    const Floats scale = all(1.0f) / greater(dot(axis, axis), all(1e-9f));
    first = texels.mean + axis * ((from + margin) * scale);
    second = texels.mean + axis * ((to - margin) * scale);
}

/// The ends that fit best to texels at the shares `weights` of the way from first to second; where
/// all texels are at one place the ends stay.
template <int N>
inline void leastSquares(const Texels<N>& texels, const Floats* weights, Color<N>& first,
                         Color<N>& second)
{
    Floats aa = all(0.0f), ab = aa, bb = aa;
    Color<N> ax = uniform<N>(0.0f), bx = ax;
    for (int k = 0; k < 16; ++k)
    {
        const Floats b = weights[k], a = all(1.0f) - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ax = ax + texels.texel[k] * a;
        bx = bx + texels.texel[k] * b;
    }
    const Floats determinant = aa * bb - ab * ab;
    const Ints valid = determinant > all(1e-3f);
    const Floats scale = all(1.0f) / (valid ? determinant : all(1.0f));
    first = select(valid, (ax * bb - bx * ab) * scale, first);
    second = select(valid, (bx * aa - ax * ab) * scale, second);
}

} // namespace
