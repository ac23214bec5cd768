// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace osgPagedTexture
{

/// The encoders of blocks for one set of vector instructions, which take `lanes` blocks at once.
///
/// `texels`: RGBA of `count` blocks, red in the lowest byte; groups of `lanes` blocks each hold the
/// first texel of all their blocks, then the second, to the 16th, row by row. The last group is
/// padded. Block i goes to out + i * stride.
struct BlockKernels
{
    int lanes;
    /// BC1. `refinements`: least-squares steps; -1: cluster fit.
    void (*color)(const std::uint32_t* texels, int count, int refinements, std::uint8_t* out,
                  int stride);
    /// BC4, and alpha of BC3: one channel of the texels.
    void (*channel)(const std::uint32_t* texels, int count, int index, int refinements,
                    std::uint8_t* out, int stride);
    /// BC7 in mode 6. `refinements` as above; -1: all p-bits.
    void (*mode6)(const std::uint32_t* texels, int count, int refinements, std::uint8_t* out,
                  int stride);
};

/// One file of kernels each is compiled with its instructions. No header with inline functions that
/// others share may be included there: the linker could take these for all.
extern const BlockKernels baselineKernels, avx2Kernels, avx512Kernels;

} // namespace osgPagedTexture
