// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlendGrid.h>
#include <osgPagedTexture/SeamSamples.h>

#include <array>
#include <cstddef>
#include <vector>

namespace osgPagedTexture
{

/// Values of a grid, three channels.
using BlendValues = std::array<std::vector<double>, 3>;

struct BlendSolution
{
    int iterations = 0;    ///< The most of a channel; 0 where it was solved directly.
    double residual = 0.0; ///< Share of the right side that is left, of the worst channel.
};

/// Solves for the values with the least sum of squares of what neighbours differ by, and of what
/// both sides of the seams differ by once the values are added. `values` are the start and the
/// result. `direct`: by a factorization, for small grids. Throws std::runtime_error.
BlendSolution solveBlend(const BlendGrid& grid, const std::vector<SeamSample>& samples,
                         BlendValues& values, int iterations, double error, bool direct);

} // namespace osgPagedTexture
