// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace osgPagedTexture
{

/// The encoders of blocks for one set of vector instructions. `texels`: 16 RGBA of each block, row
/// by row; `values`: 16 bytes of each block. Block i goes to out + i * stride.
struct BlockKernels
{
    /// BC1. `refinements`: least-squares steps; -1: cluster fit.
    void (*color)(const std::uint8_t* texels, int count, int refinements, std::uint8_t* out,
                  int stride);
    /// BC4, and alpha of BC3.
    void (*channel)(const std::uint8_t* values, int count, int refinements, std::uint8_t* out,
                    int stride);
    /// BC7 in mode 6. `refinements` as above; -1: all p-bits.
    void (*mode6)(const std::uint8_t* texels, int count, int refinements, std::uint8_t* out,
                  int stride);
};

/// One file of kernels each is compiled with its instructions. No header with inline functions that
/// others share may be included there: the linker could take these for all.
extern const BlockKernels baselineKernels, avx2Kernels, avx512Kernels;

} // namespace osgPagedTexture
