// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace osgShadowVolume
{

/// Lights of a state up to which each leaf is tested for those that reach it; more go to a grid.
inline constexpr std::size_t maxListed = 32;
inline constexpr std::size_t maxUniform = 8; ///< Lights up to which a leaf has them as uniforms.

/// Bits of SurfaceKey::kit that LitPass tells its variants apart by. Uniform lights: their number
/// from bit 4, two bits for the type of each from bit 8.
enum KitBits : std::uint32_t
{
    Listed = 1,
    Gridded = 2,
    Shadowed = 4,    ///< A light of the leaf may be taken away.
    Transparent = 8, ///< Looks visibility up by its depth.
    NumberShift = 4,
    TypesShift = 8,
    TechniqueShift = 24,    ///< LightShadows::getVariantBits(), three bits.
    ShowShift = 27,         ///< Show, three bits.
    FaceNormals = 1u << 30, ///< The model has no normals: those of its triangles.
    Reflecting = 1u << 31   ///< A mirror.
};

inline std::uint32_t numberOfUniformLights(std::uint32_t kit)
{
    return (kit >> NumberShift) & 15u;
}

} // namespace osgShadowVolume
