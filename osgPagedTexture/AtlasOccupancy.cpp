// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasOccupancy.h>

#include <osgPagedTexture/AtlasCells.h>

namespace osgPagedTexture
{

class AtlasOccupancy::Index : public AtlasCellIndex
{
public:
    using AtlasCellIndex::AtlasCellIndex;
};

AtlasOccupancy::AtlasOccupancy(const AtlasLayout& layout)
{
    std::vector<AtlasCell> covered;
    covered.reserve(layout.photos.size());
    for (const AtlasPhoto& photo : layout.photos)
    {
        const PixelRect rect = layout.getCovered(photo);
        covered.push_back({rect.x, rect.y, rect.width, rect.height});
    }
    auto index = std::make_unique<Index>(covered);
    for (const AtlasCell& cell : covered)
    {
        index->add(cell);
    }
    _index = std::move(index);
}

AtlasOccupancy::~AtlasOccupancy() = default;

bool AtlasOccupancy::holdsAny(const PixelRect& pixels, int level) const
{
    const std::int64_t scale = std::int64_t(1) << level;
    return _index->anyOver(
        {pixels.x * scale, pixels.y * scale, pixels.width * scale, pixels.height * scale});
}

} // namespace osgPagedTexture
