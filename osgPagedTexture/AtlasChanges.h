// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/PhotoFolder.h>

#include <string>
#include <vector>

namespace osgPagedTexture
{

/// What has become of the photographs of a layout since it was made.
struct AtlasChanges
{
    struct Move
    {
        std::string from;
        AtlasPhoto to;
    };
    std::vector<AtlasPhoto> changed;   ///< Other content; as the files are now, without places.
    std::vector<AtlasPhoto> added;     ///< Files that the layout does not know.
    std::vector<std::string> removed;  ///< Paths of files that are no more.
    std::vector<Move> moved;           ///< The same content at another path.
    std::vector<AtlasPhoto> restamped; ///< The same content with another time.
    /// Files that cannot be read now; what the layout knows of them stays.
    std::vector<DescribedPhotos::Failure> failures;

    /// Whether a layout stays as it is.
    bool empty() const;
};

/// The photographs of a layout and all that are in its photoFolder, relative to `folder`, that of
/// the layout's file. Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> findPhotosOf(const AtlasLayout& layout,
                                                             const std::string& folder);

/// Compares a layout with the files `paths`, relative to its `folder`. A file of known size and
/// time counts as unchanged; of all others the content decides, and with `lookInside` of each one.
/// Reads with `threads` threads (0: as many as the machine has cores).
OSGPAGEDTEXTURE_EXPORT AtlasChanges findChanges(const AtlasLayout& layout,
                                                const std::string& folder,
                                                const std::vector<std::string>& paths,
                                                bool lookInside = false, unsigned int threads = 0);

/// Brings a layout up to date: the others keep their places, a photograph of another size too where
/// it has room, and all parts of the atlas whose pixels may be others become pending. Returns one
/// line for each photograph that now lies elsewhere, or whose used parts do not fit its new size:
/// it keeps its former state.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> applyChanges(AtlasLayout& layout,
                                                             const AtlasChanges& changes);

} // namespace osgPagedTexture
