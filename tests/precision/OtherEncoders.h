// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace precision
{

/// Somebody else's encoder of BC1.
struct OtherEncoder
{
    std::string name, knob;
    std::vector<double> values; ///< Of the knob.
    /// RGB, sides multiples of 4; to rows of blocks, the picture's first row first.
    std::function<std::vector<std::uint8_t>(const osgPagedTexture::Pixels&, double value)> encode;
};

/// Those that were installed when this was built.
std::vector<OtherEncoder> getOtherEncoders();

} // namespace precision
