// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// Light of sRGB values in 1/65535, and back: in the dark, where the curve is steepest, a step is
/// 1/20 of a code value.
struct LightTables
{
    std::array<std::uint16_t, 256> light{};
    std::vector<std::uint8_t> code = std::vector<std::uint8_t>(65536);

    static const LightTables& get();

private:
    LightTables();
};

} // namespace osgPagedTexture
