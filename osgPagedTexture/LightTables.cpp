// SPDX-License-Identifier: MIT
#include <osgPagedTexture/LightTables.h>

#include <cmath>

namespace osgPagedTexture
{

LightTables::LightTables()
{
    for (int i = 0; i < 256; ++i)
    {
        const double v = i / 255.0;
        const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        light[i] = static_cast<std::uint16_t>(std::lround(65535.0 * linear));
    }
    for (int i = 0; i < 65536; ++i)
    {
        const double v = i / 65535.0;
        const double srgb = v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
        code[i] = static_cast<std::uint8_t>(std::lround(255.0 * srgb));
    }
}

const LightTables& LightTables::get()
{
    static const LightTables tables;
    return tables;
}

} // namespace osgPagedTexture
