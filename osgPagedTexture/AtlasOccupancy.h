// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>

#include <memory>

namespace osgPagedTexture
{

/// Says where in an atlas there are photographs, in a time that does not grow with their number.
class AtlasOccupancy
{
public:
    explicit AtlasOccupancy(const AtlasLayout& layout);
    ~AtlasOccupancy();

    /// Whether pixels of a level hold any of a photograph or of its padding.
    bool holdsAny(const PixelRect& pixels, int level) const;

private:
    class Index;
    std::unique_ptr<const Index> _index;
};

} // namespace osgPagedTexture
