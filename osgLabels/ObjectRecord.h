// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <cstring>

namespace osgLabels
{

/// What an object's surface is labelled as. The numbers are those of placement.glsl.
enum class Shape : std::uint32_t
{
    None = 0,
    Box = 1,       ///< size: half extents. Also the projection of meshes that are no shape.
    Cylinder = 2,  ///< size: radius, radius, half length; the axis is z.
    Sphere = 3,    ///< size: radius three times.
    Dish = 4,      ///< Half ellipsoid over the xy plane. size: radius, radius, height.
    Frustum = 5,   ///< size: radius at -z, radius at +z, half length; a cone has one radius 0.
    Pyramid = 6,   ///< size: half extents at -z in x and y, half height; the apex is at +z.
    Torus = 7,     ///< Ring in xy from +x. size: ring radius, tube radius, angle in radians.
    Quad = 8,      ///< In xy, labelled on both sides. size: half extents, z unused.
    Extrusion = 9, ///< Along z. size: half extents.
    TexCoord = 10  ///< The model's own texture coordinates; see fitTexCoords().
};

/// Bits beside the shape's number.
enum ShapeFlags : std::uint32_t
{
    ShapeMask = 0xffu,
    Projected = 0x100u, ///< A box around a mesh that was not recognised as a shape.
    /// From this bit on, for x, y and z, how much of the faces across the axis no text may use, in
    /// fifteenths; RoomBits each.
    RoomShift = 9,
    RoomBits = 4,
    Bent = 0x200u ///< Of TexCoord, which has no rooms.
};

/// What the fragment shader knows of one labelled object: 48 bytes in a texture buffer, three
/// texels of four 32-bit integers.
struct ObjectRecord
{
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f}; ///< From local coordinates to the shape's frame.
    glm::vec3 origin{0.0f};                     ///< Of the shape's frame, in local coordinates.
    std::uint32_t shape = 0;                    ///< Shape and ShapeFlags.
    glm::vec3 size{0.0f};                       ///< See Shape; in units of the local coordinates.
    std::uint32_t identifier = 0;               ///< Of the label; 0 for none.

    static constexpr std::size_t Words = 12, IdentifierWord = 11;

    std::array<std::uint32_t, Words> pack() const
    {
        std::array<std::uint32_t, Words> words{};
        const float first[] = {rotation.x, rotation.y, rotation.z, rotation.w,
                               origin.x,   origin.y,   origin.z};
        std::memcpy(words.data(), first, sizeof first);
        words[7] = shape;
        std::memcpy(words.data() + 8, &size[0], 3 * sizeof(float));
        words[IdentifierWord] = identifier;
        return words;
    }
};

} // namespace osgLabels
