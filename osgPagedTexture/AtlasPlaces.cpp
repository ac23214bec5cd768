// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasPlaces.h>

#include <algorithm>
#include <filesystem>

namespace osgPagedTexture
{

AtlasPlaces::AtlasPlaces(const AtlasLayout& layout, const std::string& folder) : _layout(layout)
{
    const std::filesystem::path base(folder);
    for (std::size_t i = 0; i < layout.photos.size(); ++i)
    {
        std::error_code failure;
        const auto path = std::filesystem::weakly_canonical(base / layout.photos[i].path, failure);
        if (!failure)
            _pieces[path.string()].push_back(i);
    }
}

const std::vector<std::size_t>* AtlasPlaces::find(const std::string& file) const
{
    const auto found = _pieces.find(file);
    return found == _pieces.end() ? nullptr : &found->second;
}

std::size_t AtlasPlaces::pieceOf(const std::vector<std::size_t>& pieces, const glm::dvec2& low,
                                 const glm::dvec2& high) const
{
    constexpr double Missing = 0.5;
    const auto has = [&](std::size_t number)
    {
        const AtlasPhoto& photo = _layout.photos[number];
        const PixelRect box = photo.getBox();
        const double left = double(box.x) - Missing, top = double(box.y) - Missing;
        return low.x * photo.width >= left && (1.0 - high.y) * photo.height >= top &&
               high.x * photo.width <= double(box.x + box.width) + Missing &&
               (1.0 - low.y) * photo.height <= double(box.y + box.height) + Missing;
    };
    return std::size_t(std::find_if(pieces.begin(), pieces.end(), has) - pieces.begin());
}

glm::dvec2 AtlasPlaces::place(std::size_t number, const glm::dvec2& point) const
{
    const AtlasPhoto& photo = _layout.photos[number];
    const double x = double(photo.x) + point.x * photo.width;
    const double y = double(_layout.height - photo.y - photo.height) + point.y * photo.height;
    return {x / double(_layout.width), y / double(_layout.height)};
}

glm::dvec2 AtlasPlaces::firstPixel(std::size_t number) const
{
    const AtlasPhoto& photo = _layout.photos[number];
    const PixelRect box = photo.getBox();
    return {(double(box.x) + 0.5) / photo.width, 1.0 - (double(box.y) + 0.5) / photo.height};
}

} // namespace osgPagedTexture
