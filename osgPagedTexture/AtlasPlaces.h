// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>

#include <glm/vec2.hpp>

#include <map>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Where points of photographs are in an atlas.
class AtlasPlaces
{
public:
    /// `folder` is that of the layout's file. The layout has to live as long.
    AtlasPlaces(const AtlasLayout& layout, const std::string& folder);

    /// Numbers of a photograph's pieces in the layout; null where it has none. `file` is absolute.
    const std::vector<std::size_t>* find(const std::string& file) const;

    /// The first of the pieces that has all of a box, in shares of the photograph, t from the
    /// bottom; of pieces.size() where none has it. Half a pixel may be missing at each side.
    std::size_t pieceOf(const std::vector<std::size_t>& pieces, const glm::dvec2& low,
                        const glm::dvec2& high) const;

    /// A point of the photograph, 0 to 1 from its bottom left, as one of the atlas.
    glm::dvec2 place(std::size_t photo, const glm::dvec2& point) const;

    /// The middle of the pixel at the top left of what is placed, in shares of the photograph.
    glm::dvec2 firstPixel(std::size_t photo) const;

private:
    const AtlasLayout& _layout;
    std::map<std::string, std::vector<std::size_t>> _pieces;
};

} // namespace osgPagedTexture
