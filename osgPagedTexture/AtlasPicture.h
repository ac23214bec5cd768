// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/TileBuilder.h>

#include <cstdint>
#include <string>
#include <vector>

namespace osgPagedTexture
{

struct AtlasPictureSettings
{
    /// "atlas.png" becomes atlas.png where there is one part, else atlas_<x>_<y>.png; .ppm, .tif
    /// and what else OpenImageIO writes.
    std::string path;
    std::int64_t partSide = 65500; ///< Of the largest part, in pixels, 1 to 2^30.
    int channels = 3;
    TileColor background{255, 255, 255, 255};
    unsigned int threads = 0;
};

struct AtlasPictureReport
{
    std::vector<std::string> files; ///< That were written.
    std::vector<PhotoFailure> failures;
};

/// Writes an atlas as pictures, for programs that want it; a tile store needs none. Each photograph
/// is decoded once and no more than some rows are in memory. Only the parts that hold any pixel of
/// `changed` are written, each replaced as a whole. `folder`: that the photographs' paths are
/// relative to. Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT AtlasPictureReport writeAtlas(const AtlasLayout& layout,
                                                     const std::string& folder,
                                                     const AtlasPictureSettings& settings,
                                                     const PixelRect& changed,
                                                     const TileBuilder::Progress& progress = {});

/// All parts.
inline AtlasPictureReport writeAtlas(const AtlasLayout& layout, const std::string& folder,
                                     const AtlasPictureSettings& settings)
{
    return writeAtlas(layout, folder, settings, {0, 0, layout.width, layout.height});
}

} // namespace osgPagedTexture
