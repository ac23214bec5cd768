// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// What a texture shows where a coordinate lies outside of 0 to 1.
enum class PhotoWrap : std::uint8_t
{
    Clamp, ///< The edge's pixels.
    Repeat,
    Mirror ///< Every other repeat is turned round.
};

/// Triangles of a model that show a photograph, three corners each.
struct PhotoSurface
{
    PhotoWrap wrapS = PhotoWrap::Clamp;
    PhotoWrap wrapT = PhotoWrap::Clamp;
    std::vector<glm::vec2> coordinates; ///< 0 to 1 is the photograph, t from the bottom.
    std::vector<glm::dvec3> places;     ///< In the model's coordinates; empty where not asked for.
    std::size_t skipped = 0;            ///< Triangles that are left out: a number isn't finite.
};

/// A photograph and what of a model shows it.
struct Photo
{
    std::string file; ///< Where it was found, absolute.
    std::string name; ///< As the model has it.
    int width = 0;    ///< As shown, in pixels.
    int height = 0;
    std::vector<PhotoSurface> surfaces; ///< One for each kind of wrap.
};

/// What of a model's textures is no photograph of it, and why.
struct LeftSurface
{
    std::string name;
    std::string reason;
};

} // namespace osgPagedTexture
